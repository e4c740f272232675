#pragma once

#include <memory>

#include "watch/session.hpp"

namespace drape {

/// Shows what a session draws as a page on 127.0.0.1, until it is destroyed. Nobody else's machine can ask for it, nor
/// can another site's page in the same browser: a request must name this address.
class WatchServer {
 public:
  /// @param session must outlive it
  /// @param port    0: any that is free
  /// @throws OutputError if the port cannot be used
  WatchServer(const WatchSession& session, int port);
  ~WatchServer();
  WatchServer(const WatchServer&) = delete;
  WatchServer& operator=(const WatchServer&) = delete;

  /// "http://127.0.0.1:8000/"
  [[nodiscard]] std::string address() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace drape
