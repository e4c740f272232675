#include "cli/watch/session.hpp"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <nlohmann/json.hpp>
#include <regex>
#include <system_error>
#include <thread>
#include <utility>

#include "core/files.hpp"
#include "drape/core/error.hpp"
#include "watch_assets.hpp"

namespace drape {

FileStamps::FileStamps(const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files) {
    Stamp& stamp = stamps_[file];
    std::error_code error;
    stamp.written = std::filesystem::last_write_time(file, error);
    if (!error) stamp.size = std::filesystem::file_size(file, error);
    stamp.there = !error;
    if (!stamp.there) stamp = {};
  }
}

void FileStamps::follow(const std::vector<std::filesystem::path>& files) {
  FileStamps next(files);
  for (auto& [file, stamp] : next.stamps_) {
    if (const auto known = stamps_.find(file); known != stamps_.end()) stamp = known->second;
  }
  *this = std::move(next);
}

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto look_again = std::chrono::milliseconds(100);
constexpr std::size_t most_film_bytes = std::size_t{1} << 30, most_scene_bytes = std::size_t{1} << 24;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// Adds the files that a scene may name: its quoted texts, as paths beside it. They need not exist.
void add_named_files(const std::filesystem::path& scene, std::vector<std::filesystem::path>& files) {
  std::string text;
  try {
    text = read_file(scene, most_scene_bytes);
  } catch (const Error&) {
    return;  // reported when it is drawn
  }
  static const std::regex quoted(R"re("([^"\n]{1,255})"|'([^'\n]{1,255})')re");
  for (std::sregex_iterator match(text.begin(), text.end(), quoted), end; match != end; ++match) {
    const std::filesystem::path file = scene.parent_path() / ((*match)[1].matched ? (*match)[1] : (*match)[2]).str();
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
  }
}

}  // namespace

WatchSession::WatchSession(std::filesystem::path file, std::vector<std::string> overrides, GlBackend backend,
                           Describe describe)
    : file_(std::move(file)),
      overrides_(std::move(overrides)),
      backend_(backend),
      describe_(std::move(describe)),
      inputs_{file_} {}

WatchedFilm WatchSession::film() const {
  const std::lock_guard lock(mutex_);
  return film_;
}

void WatchSession::publish(const std::function<void(WatchedFilm&)>& change) {
  const std::lock_guard lock(mutex_);
  change(film_);
  ++film_.version;
}

void WatchSession::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    // The loader tells the files of a valid scene only.
    add_named_files(file_, inputs_);
    stamps_ = FileStamps(inputs_);
    publish([](WatchedFilm& film) { film.running = true; });
    try {
      draw(stop);
      publish([](WatchedFilm& film) { film.running = false; });
    } catch (const Error& error) {
      publish([&](WatchedFilm& film) {
        film.running = false;
        film.errors = lines_of(error.what());
      });
    }
    while (!stop.stop_requested() && !changed()) std::this_thread::sleep_for(look_again);
  }
}

void WatchSession::draw(const std::stop_token& stop) {
  const auto begin = Clock::now();
  const LoadedScene scene = load_scene(file_, overrides_);
  const double load = seconds_since(begin);
  inputs_ = scene.source.inputs;
  stamps_.follow(inputs_);

  const TemporaryFolder folder("drape-watch");
  const std::string path = (folder.path() / "film.gif").string();
  RunOptions options;
  options.outputs = {path};
  options.backend = backend_;
  options.threads = 0;
  std::stop_source changed_or_stopped;
  auto work = std::async(std::launch::async,
                         [&] { return run_scene(scene, options, changed_or_stopped.get_token(), progress_); });
  while (work.wait_for(look_again) != std::future_status::ready) {
    if (stop.stop_requested() || changed()) changed_or_stopped.request_stop();
  }
  const RunResult result = work.get();
  if (result.outcome == Outcome::interrupted) return;
  const std::string shown = result.outputs.empty() ? path : result.outputs.front().front().path.string();
  std::string bytes = result.outputs.empty() ? "" : read_file(shown, most_film_bytes);
  publish([&](WatchedFilm& film) {
    film.errors = result.problems;
    if (!result.divergence.empty()) film.errors.push_back(file_.string() + ": " + result.divergence);
    film.hints = scene.source.warnings;
    film.summary = describe_(scene, options);
    if (!bytes.empty()) {
      film.film = std::move(bytes);
      ++film.film_number;
    }
    film.load = load;
    film.simulate = result.statistics.total_seconds();
    film.draw = result.draw_seconds;
    film.encode = result.write_seconds;
    film.total = seconds_since(begin);
  });
}

namespace {

constexpr const char* host = "127.0.0.1";
constexpr int workers = 32;  // more than a few browsers' idle connections
constexpr int patience = 1;  // time limit for receiving a request [s]

/// Lets a port be reused at once after its server has ended, but by one server at a time. The library's own options let
/// several servers share it.
void take_port_alone(int socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

/// Returns the session's state as JSON, which the page polls.
std::string state_text(const WatchSession& session) {
  const WatchedFilm film = session.film();
  const Progress& progress = session.progress();
  const nlohmann::json state{
      {"version", film.version},
      {"running", film.running},
      {"errors", film.errors},
      {"hints", film.hints},
      {"summary", film.summary},
      {"film", film.film_number},
      {"progress",
       {{"stage", progress.stage.load()}, {"done", progress.done.load()}, {"total", progress.total.load()}}},
      {"seconds",
       {{"load", film.load},
        {"simulate", film.simulate},
        {"draw", film.draw},
        {"encode", film.encode},
        {"total", film.total}}}};
  return state.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

struct WatchServer::Parts {
  httplib::Server server;
  int port = 0;
  std::atomic<bool> ended = false;
  std::jthread thread;

  ~Parts() { server.stop(); }
};

WatchServer::WatchServer(const WatchSession& session, int port) : parts_(std::make_unique<Parts>()) {
  httplib::Server& server = parts_->server;
  server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    const std::string name = request.get_header_value("Host");
    for (const char* own : {host, "localhost"}) {
      if (name == fmt::format("{}:{}", own, parts_->port)) return httplib::Server::HandlerResponse::Unhandled;
    }
    response.status = 403;
    return httplib::Server::HandlerResponse::Handled;
  });
  server.Get("/", [](const httplib::Request&, httplib::Response& response) {
    response.set_content(std::string(html::watch_html), "text/html; charset=utf-8");
  });
  server.Get("/state", [&session](const httplib::Request&, httplib::Response& response) {
    response.set_header("Cache-Control", "no-store");
    response.set_content(state_text(session), "application/json");
  });
  server.Get("/film.gif", [&session](const httplib::Request&, httplib::Response& response) {
    response.set_header("Cache-Control", "no-store");
    response.set_content(session.film().film, "image/gif");
  });
  server.set_socket_options(take_port_alone);
  server.new_task_queue = [] { return new httplib::ThreadPool(workers); };  // the server deletes it
  server.set_keep_alive_max_count(1);
  server.set_keep_alive_timeout(patience);
  server.set_read_timeout(patience);
  parts_->port = port != 0 && server.bind_to_port(host, port) ? port : port == 0 ? server.bind_to_any_port(host) : -1;
  if (parts_->port < 0) throw OutputError(fmt::format("cannot listen on port {} of {}: it is in use", port, host));
  parts_->thread = std::jthread([this] {
    parts_->server.listen_after_bind();
    parts_->ended = true;
  });
  // Wait until the server listens: only then can it be stopped.
  while (!server.is_running() && !parts_->ended) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

WatchServer::~WatchServer() = default;

std::string WatchServer::address() const { return fmt::format("http://{}:{}/", host, parts_->port); }

}  // namespace drape
