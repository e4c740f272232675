#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace httplib {
class Client;
}

namespace drape::test {

/// A headless Chromium, driven through chromedriver by the WebDriver protocol (W3C).
class Browser {
 public:
  /// Why there is no browser on this machine; empty if there is one.
  static std::string missing();

  /// @throws std::runtime_error if it does not start
  Browser();
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// Goes on in a new tab, as if the browser had just been started, which takes far longer.
  void open_tab();

  /// Opens a file by its file:// address and forgets what was reported of earlier pages.
  void open(const std::filesystem::path& file);

  /// @param dark whether the person prefers dark pages
  void set_theme(bool dark);
  /// Shows the page as it is printed, until the next set_theme().
  void set_print(bool dark);
  /// @param width of the window's inside [CSS pixels]
  void set_width(int width);

  /// Runs the body of a JavaScript function in the page and returns its result.
  nlohmann::json run(const std::string& body);

  /// Presses keys where the focus is, as a person would: plain characters, or the key codes of WebDriver.
  void press(const std::string& keys);
  /// Moves the pointer to the middle of the first element that the CSS selector finds, without pressing it.
  void point_at(const std::string& selector);
  void click(const std::string& selector);

  /// Errors and warnings in the console since open().
  std::vector<std::string> console_problems();
  /// Addresses that were asked for since open(), without data: and the page itself.
  std::vector<std::string> requests();

  /// A picture of the whole page, not only of the part in the window.
  void save_screenshot(const std::filesystem::path& png);

  static constexpr const char* arrow_left = "\uE012";
  static constexpr const char* arrow_right = "\uE014";
  static constexpr const char* tab = "\uE004";

 private:
  nlohmann::json post(const std::string& path, const nlohmann::json& body);
  nlohmann::json command(const std::string& name, const nlohmann::json& parameters);
  nlohmann::json log(const std::string& kind);
  void move_pointer(const std::string& selector, bool press);

  pid_t driver_ = -1;
  std::unique_ptr<httplib::Client> client_;
  std::string session_, page_;
};

}  // namespace drape::test
