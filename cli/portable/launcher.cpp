// bin/drape of the portable archive: starts libexec/drape with the archive's own loader and libraries, independent of
// the libc and other libraries of the system.

#include <unistd.h>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace {

constexpr int cannot_start = 2;  // same code as for other usage errors

int fail(const std::string& message) {
  std::fprintf(stderr, "drape: %s\n", message.c_str());
  return cannot_start;
}

}  // namespace

int main(int argc, char** argv) {
  std::array<char, PATH_MAX> self{};
  const ssize_t length = readlink("/proc/self/exe", self.data(), self.size());
  if (length <= 0 || length == PATH_MAX) return fail("cannot find its own folder: /proc is not mounted");
  std::string root(self.data(), static_cast<std::size_t>(length));
  for (int above = 0; above < 2; ++above) root.erase(root.rfind('/'));  // remove /bin/drape
  if (root.find_first_of(":;$") != std::string::npos) {
    return fail("cannot run in a folder whose path contains ':', ';' or '$': " + root);
  }
  std::string loader = root + "/libexec/loader/drape", libraries = root + "/lib", program = root + "/libexec/drape";
  std::string inhibit_cache = "--inhibit-cache", library_path = "--library-path", argv0 = "--argv0", name = "drape";
  std::vector<char*> arguments{loader.data(),    inhibit_cache.data(), library_path.data(),
                               libraries.data(), argv0.data(),         argc > 0 ? argv[0] : name.data(),
                               program.data()};
  for (int i = 1; i < argc; ++i) arguments.push_back(argv[i]);
  arguments.push_back(nullptr);
  execv(loader.c_str(), arguments.data());
  return fail("cannot start " + loader + ": " + std::strerror(errno));
}
