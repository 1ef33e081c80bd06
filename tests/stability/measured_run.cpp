#include "stability/measured_run.h"

namespace lancer::stability {

MeasuredRun measured_run(const TempFolder& folder, const std::vector<std::string>& arguments,
                         const std::vector<std::string>& environment)
{
    const auto cpu = [] {
        rusage usage{};
        getrusage(RUSAGE_CHILDREN, &usage);
        const auto seconds = [](const timeval& t) {
            return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
        };
        return seconds(usage.ru_utime) + seconds(usage.ru_stime);
    };
    MeasuredRun run;
    const double before = cpu();
    const auto start = std::chrono::steady_clock::now();
    Program program(folder, arguments, environment);
    const std::string status = "/proc/" + std::to_string(program.pid()) + "/status";
    for (siginfo_t info{}; info.si_pid == 0;) {
        const std::string text = read_bytes(status);
        const size_t at = text.find("VmHWM:");  // of what the program itself had, not of who started it
        if (at != std::string::npos) run.peak_mb = std::max(run.peak_mb, std::stod(text.substr(at + 6)) / 1024);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        waitid(P_PID, static_cast<id_t>(program.pid()), &info, WEXITED | WNOWAIT | WNOHANG);
    }
    run.said = program.wait();
    run.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    run.cpu_seconds = cpu() - before;
    return run;
}

}  // namespace lancer::stability
