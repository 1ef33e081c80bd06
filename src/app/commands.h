// The commands, each in cmd_NAME.cpp. argv[0] is the command's name. Returns the exit code; what goes wrong is thrown.
#pragma once

namespace lancer {

constexpr int exit_done = 0, exit_failed = 1, exit_usage = 2, exit_invalid = 65, exit_missing = 66,
              exit_interrupted = 130;

int run_render(int argc, char** argv);
int run_compare(int argc, char** argv);
int run_check(int argc, char** argv);
int run_info(int argc, char** argv);
int run_pixel(int argc, char** argv);

}  // namespace lancer
