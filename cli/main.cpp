#include "cli/command_line.hpp"

int main(int argc, char** argv) { return static_cast<int>(drape::run_command_line(argc, argv)); }
