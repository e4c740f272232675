#include "cli/watch/session.hpp"  // before httplib.h: <resolv.h> defines _res, which Eigen has as a name

#include <arpa/inet.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <stop_token>
#include <thread>

#include "core/files.hpp"
#include "tests/html/html_page.hpp"

// A page that shows a scene while it is edited: a colour changes, a mistake is made and corrected.

namespace drape::watched_scene {
namespace {

const std::string scene =
    "[cloth]\nmesh = { grid = [4, 4] }\nstiffness = 50\npins = [\"edge:y+\"]\n"
    "[time]\nstep = 0.02\nduration = 0.2\n[video]\nsize = [64, 48]\n[effects.gravity]\n[look]\nsamples = 1\n";

/// A session with its server, which end with it.
struct Watched {
  explicit Watched(const std::filesystem::path& file)
      : session(file, {}, GlBackend::automatic, [](const Scene& s, const RunOptions&) { return s.name + " is drawn"; }),
        server(session, 0),
        thread([this](const std::stop_token& stop) { session.run(stop); }) {}
  WatchSession session;
  WatchServer server;
  std::jthread thread;
};

class WatchPage : public test::InBrowser {
 protected:
  /// Saves a file in one step, so that a session never sees it half-written, which it would draw as a scene of its own.
  void save(const std::string& name, const std::string& text) const { write_file_atomically(path(name), text); }

  /// Returns the colour in the middle of the film's picture: red, green, blue.
  std::vector<int> middle() {
    return browser_->run(
        "const film = document.getElementById('film'), canvas = document.createElement('canvas');"
        "canvas.width = film.naturalWidth; canvas.height = film.naturalHeight; const c = canvas.getContext('2d');"
        "c.drawImage(film, 0, 0); return [...c.getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data].slice(0, "
        "3)");
  }
};

const char* const up_to_date = "document.getElementById('state').textContent === 'up to date'";

TEST_F(WatchPage, ShowsAChangeAMistakeAndItsMend) {
  save("flag.toml", scene + "color = \"red\"\n");
  const Watched watched(path("flag.toml"));
  browser_->run("location.href = '" + watched.server.address() + "'");
  const std::string drawn = std::string(up_to_date) +
                            " && document.getElementById('film').complete && "
                            "document.getElementById('film').naturalWidth > 0";
  wait_for(drawn);
  EXPECT_GT(middle()[0], 2 * middle()[2]) << "it is red";
  EXPECT_NE(browser_->run("return document.body.innerText").get<std::string>().find("flag is drawn"),
            std::string::npos);

  save("flag.toml", scene + "color = \"blue\"\n");
  wait_for("document.getElementById('film').src.endsWith('?2') && " + drawn);
  EXPECT_GT(middle()[2], 2 * middle()[0]) << "it is blue";

  save("flag.toml", scene + "colour = \"blue\"\n");
  wait_for("document.getElementById('errors').textContent.includes('flag.toml:13:1: unknown key')");
  EXPECT_EQ(browser_->run("return document.getElementById('film').className"), "old");

  save("flag.toml", scene + "color = \"lime\"\n");
  wait_for("document.getElementById('film').src.endsWith('?3') && " + drawn);
  EXPECT_EQ(browser_->run("return document.getElementById('errors').textContent"), "");
  EXPECT_GT(middle()[1], 2 * middle()[0]) << "it is green";
}

// Browsers show a broken picture for an image without a file.
TEST_F(WatchPage, ShowsNoPictureBeforeTheFirstFilm) {
  save("flag.toml", scene + "colour = \"red\"\n");
  const Watched watched(path("flag.toml"));
  browser_->run("location.href = '" + watched.server.address() + "'");
  wait_for("document.getElementById('errors').textContent.includes('unknown key')");
  const std::string display = "return getComputedStyle(document.getElementById('film')).display";
  EXPECT_EQ(browser_->run(display), "none");
  save("flag.toml", scene + "color = \"red\"\n");
  wait_for("document.getElementById('film').src.endsWith('?1')");
  EXPECT_EQ(browser_->run(display), "block");
}

TEST_F(WatchPage, SeesAMeshThatIsSavedAndStopsWhatIsRunning) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 0 ";
  save("cloth.obj", triangle + "x\nf 1 2 3\n");  // never loaded until it is mended
  const std::string own = "[cloth]\nmesh = \"cloth.obj\"\nstiffness = 50\n[time]\nstep = 0.02\nduration = ";
  save("a.toml", own + "0.1\n[video]\nsize = [32, 32]\n");
  Watched watched(path("a.toml"));
  const auto wait_for_film = [&](int number) {
    for (int i = 0; i < 600 && watched.session.film().film_number < number; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    EXPECT_EQ(watched.session.film().film_number, number);
  };
  for (int i = 0; i < 600 && watched.session.film().errors.empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  save("cloth.obj", triangle + "1\nf 1 2 3\n");
  wait_for_film(1);
  save("cloth.obj", triangle + "2\nf 1 2 3\n");
  wait_for_film(2);
  save("a.toml", own + "1e5\n[video]\nspeed = 1e5\nsize = [32, 32]\n");  // takes minutes
  for (int i = 0; i < 600 && watched.session.progress().total < 1'000'000; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  save("a.toml", own + "0.1\n[video]\nsize = [32, 32]\n");
  wait_for_film(3);
}

TEST(WatchServer, AnswersNobodyWhoNamesAnotherPlace) {
  const WatchSession session("none.toml", {}, GlBackend::automatic, {});
  const WatchServer server(session, 0);
  const std::string address = server.address();
  httplib::Client client(address.substr(0, address.size() - 1));
  EXPECT_EQ(client.Get("/state")->status, 200);
  EXPECT_EQ(client.Get("/nothing")->status, 404);
  EXPECT_EQ(client.Get("/state", {{"Host", "example.org"}})->status, 403);
  const int port = std::stoi(address.substr(address.rfind(':') + 1));
  EXPECT_THROW(WatchServer(session, port), OutputError);
}

/// Opens a connection without sending anything.
int connect_silently(int port) {
  const int connection = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(static_cast<std::uint16_t>(port));
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(connect(connection, reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
  return connection;
}

// Browsers open connections ahead of time and keep them.
TEST(WatchServer, AnswersBesideConnectionsThatSayNothing) {
  const WatchSession session("none.toml", {}, GlBackend::automatic, {});
  const WatchServer server(session, 0);
  const std::string address = server.address();
  const int port = std::stoi(address.substr(address.rfind(':') + 1));
  std::vector<int> silent;
  for (int i = 0; i < 24; ++i) silent.push_back(connect_silently(port));
  httplib::Client client(address.substr(0, address.size() - 1));
  const httplib::Result state = client.Get("/state");
  ASSERT_TRUE(state) << "no answer in the client's five seconds";
  EXPECT_EQ(state->status, 200);
  for (const int connection : silent) close(connection);
}

}  // namespace
}  // namespace drape::watched_scene
