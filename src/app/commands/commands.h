// The commands, each in NAME.cpp. argv[0] is the command's name. Each returns the exit code and throws errors.
#pragma once

#include "app/exit_code.h"

namespace lancer {

int run_render(int argc, char** argv);
int run_film(int argc, char** argv);
int run_view(int argc, char** argv);
int run_denoise(int argc, char** argv);
int run_merge(int argc, char** argv);
int run_verify(int argc, char** argv);
int run_slurm(int argc, char** argv);
int run_compare(int argc, char** argv);
int run_check(int argc, char** argv);
int run_info(int argc, char** argv);
int run_study(int argc, char** argv);
int run_pixel(int argc, char** argv);
int run_bench(int argc, char** argv);
int run_export(int argc, char** argv);
int run_tune(int argc, char** argv);
int run_options(int argc, char** argv);

}  // namespace lancer
