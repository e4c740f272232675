#pragma once

#include <memory>

#include "watch/session.hpp"

namespace drape {

/// HTTP server on 127.0.0.1 for a session's page, until destroyed. Other machines cannot reach it. A request must name
/// this address, which excludes pages of other sites in the same browser.
class WatchServer {
 public:
  /// @param session outlives the server
  /// @param port    0: any free port
  /// @throws OutputError if the port is not available
  WatchServer(const WatchSession& session, int port);
  ~WatchServer();
  WatchServer(const WatchServer&) = delete;
  WatchServer& operator=(const WatchServer&) = delete;

  /// Returns "http://127.0.0.1:8000/".
  [[nodiscard]] std::string address() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace drape
