#include "watch/server.hpp"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/error.hpp"
#include "watch_assets.hpp"

namespace drape {
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
