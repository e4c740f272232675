#include "tests/support/browser.hpp"

#include <fcntl.h>
#include <httplib.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace drape::test {
namespace {

using Json = nlohmann::json;

/// Returns the path of a program on the PATH; empty if there is none.
std::string find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::string file = folder + "/" + name;
    if (access(file.c_str(), X_OK) == 0) return file;
  }
  return {};
}

/// Starts chromedriver on a free port and returns its process and the port that it prints.
std::pair<pid_t, int> start_driver() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  const std::string program = find_program("chromedriver");
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
    execl(program.c_str(), program.c_str(), "--port=0", static_cast<char*>(nullptr));
    _exit(127);
  }
  close(ends[1]);
  const std::string marker = "successfully on port ";
  std::string text;
  char letter = 0;
  while (read(ends[0], &letter, 1) == 1) {
    text += letter;
    const std::size_t at = text.find(marker);
    if (at != std::string::npos && letter == '\n') {
      close(ends[0]);
      return {child, std::stoi(text.substr(at + marker.size()))};
    }
  }
  close(ends[0]);
  waitpid(child, nullptr, 0);
  throw std::runtime_error("chromedriver did not start: " + text);
}

std::string decode_base64(const std::string& text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::size_t value = alphabet.find(c);
    if (value == std::string::npos) break;
    bits = bits << 6 | static_cast<unsigned>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xff);
  }
  return bytes;
}

}  // namespace

std::string Browser::missing() {
  if (find_program("chromedriver").empty() || find_program("chromium").empty()) {
    return "no headless browser: apt-get install --no-install-recommends chromium chromium-driver";
  }
  return {};
}

Browser::Browser() {
  const auto [pid, port] = start_driver();
  driver_ = pid;
  client_ = std::make_unique<httplib::Client>("127.0.0.1", port);
  client_->set_read_timeout(120);
  const Json options{
      {"binary", find_program("chromium")},
      // Containers run as root and have a small /dev/shm.
      {"args",
       {"--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu", "--enable-unsafe-swiftshader"}}};
  const Json wanted{{"browserName", "chrome"},
                    {"goog:chromeOptions", options},
                    {"goog:loggingPrefs", {{"browser", "ALL"}, {"performance", "ALL"}}}};
  session_ = "/session";
  const Json made = post("", {{"capabilities", {{"alwaysMatch", wanted}}}});
  session_ += "/" + made.at("sessionId").get<std::string>();
}

Browser::~Browser() {
  client_->Delete(session_);
  kill(driver_, SIGTERM);
  waitpid(driver_, nullptr, 0);
}

Json Browser::post(const std::string& path, const Json& body) {
  const auto response = client_->Post(session_ + path, body.dump(), "application/json");
  if (!response) throw std::runtime_error("chromedriver does not answer " + path);
  Json value = Json::parse(response->body).at("value");
  if (response->status != 200) throw std::runtime_error(path + ": " + value.at("message").get<std::string>());
  return value;
}

Json Browser::command(const std::string& name, const Json& parameters) {
  return post("/goog/cdp/execute", {{"cmd", name}, {"params", parameters}});
}

void Browser::open_tab() {
  const Json tab = post("/window/new", {{"type", "tab"}});
  client_->Delete(session_ + "/window");  // closes the previous tab
  post("/window", {{"handle", tab.at("handle")}});
}

void Browser::open(const std::filesystem::path& file) {
  log("browser");
  log("performance");
  page_ = "file://" + std::filesystem::absolute(file).string();
  post("/url", {{"url", page_}});
}

void Browser::set_theme(bool dark) {
  command("Emulation.setEmulatedMedia",
          {{"media", ""}, {"features", {{{"name", "prefers-color-scheme"}, {"value", dark ? "dark" : "light"}}}}});
}

void Browser::set_print(bool dark) {
  command("Emulation.setEmulatedMedia",
          {{"media", "print"}, {"features", {{{"name", "prefers-color-scheme"}, {"value", dark ? "dark" : "light"}}}}});
}

void Browser::set_width(int width) {
  command("Emulation.setDeviceMetricsOverride",
          {{"width", width}, {"height", 900}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

Json Browser::run(const std::string& body) {
  return post("/execute/sync", {{"script", body}, {"args", Json::array()}});
}

void Browser::press(const std::string& keys) {
  Json actions = Json::array();
  for (std::size_t i = 0; i < keys.size();) {
    std::size_t length = 1;
    while (i + length < keys.size() && (static_cast<unsigned char>(keys[i + length]) & 0xc0) == 0x80) ++length;
    const std::string key = keys.substr(i, length);
    actions.push_back({{"type", "keyDown"}, {"value", key}});
    actions.push_back({{"type", "keyUp"}, {"value", key}});
    i += length;
  }
  post("/actions", {{"actions", {{{"type", "key"}, {"id", "keyboard"}, {"actions", actions}}}}});
}

void Browser::move_pointer(const std::string& selector, bool press) {
  run("document.querySelector(" + Json(selector).dump() + ").scrollIntoView({block: 'center'})");
  const Json element = post("/element", {{"using", "css selector"}, {"value", selector}});
  Json actions = Json::array({{{"type", "pointerMove"}, {"duration", 0}, {"origin", element}, {"x", 0}, {"y", 0}}});
  if (press) {
    actions.push_back({{"type", "pointerDown"}, {"button", 0}});
    actions.push_back({{"type", "pointerUp"}, {"button", 0}});
  }
  post("/actions", {{"actions", {{{"type", "pointer"}, {"id", "mouse"}, {"actions", actions}}}}});
}

void Browser::point_at(const std::string& selector) { move_pointer(selector, false); }
void Browser::click(const std::string& selector) { move_pointer(selector, true); }

Json Browser::log(const std::string& kind) { return post("/se/log", {{"type", kind}}); }

std::vector<std::string> Browser::console_problems() {
  std::vector<std::string> problems;
  for (const Json& entry : log("browser")) {
    const std::string level = entry.at("level");
    const std::string text = entry.at("message");
    if (text.find("GL Driver Message (OpenGL, Performance") != std::string::npos)
      continue;  // on machines without a GPU
    if (level == "SEVERE" || level == "WARNING") problems.push_back(text);
  }
  return problems;
}

std::vector<std::string> Browser::requests() {
  std::vector<std::string> addresses;
  for (const Json& entry : log("performance")) {
    const Json message = Json::parse(entry.at("message").get<std::string>()).at("message");
    if (message.at("method") != "Network.requestWillBeSent") continue;
    const std::string address = message.at("params").at("request").at("url");
    if (!address.starts_with("data:") && address != page_) addresses.push_back(address);
  }
  return addresses;
}

void Browser::save_screenshot(const std::filesystem::path& png) {
  const Json size =
      run("return [innerWidth, document.documentElement.scrollHeight]");  // includes the part beneath the scrollbar
  const Json whole = {{"x", 0}, {"y", 0}, {"width", size.at(0)}, {"height", size.at(1)}, {"scale", 1}};
  const Json picture =
      command("Page.captureScreenshot", {{"format", "png"}, {"captureBeyondViewport", true}, {"clip", whole}});
  std::ofstream(png, std::ios::binary) << decode_base64(picture.at("data"));
}

}  // namespace drape::test
