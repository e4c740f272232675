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
  /// Returns why there is no browser on this machine; empty if there is one.
  static std::string missing();

  /// @throws std::runtime_error if it does not start
  Browser();
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// Continues in a new tab, equivalent to a new browser but far faster.
  void open_tab();

  /// Opens a file by its file:// address and discards reports about earlier pages.
  void open(const std::filesystem::path& file);

  /// Sets the user's preferred theme. @param dark true for dark pages
  void set_theme(bool dark);
  /// Shows the page as printed, until the next set_theme().
  void set_print(bool dark);
  /// @param width inner width of the window [CSS pixels]
  void set_width(int width);

  /// Runs the body of a JavaScript function in the page and returns its result.
  nlohmann::json run(const std::string& body);

  /// Presses keys at the focus: plain characters, or WebDriver's key codes.
  void press(const std::string& keys);
  /// Moves the pointer to the middle of the first element that the CSS selector matches, without a click.
  void point_at(const std::string& selector);
  void click(const std::string& selector);

  /// Returns errors and warnings in the console since open().
  std::vector<std::string> console_problems();
  /// Returns the addresses requested since open(), except data: addresses and the page itself.
  std::vector<std::string> requests();

  /// Saves a picture of the whole page, including parts outside the window.
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
