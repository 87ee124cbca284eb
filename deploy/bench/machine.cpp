#include "deploy/bench/machine.h"

#include <hwy/targets.h>

#include <algorithm>
#include <sstream>
#include <thread>

#include "common/base/text_file.h"
#include "deploy/json.h"

namespace shearwater::bench {

namespace {

// What follows the colon of the first line of /proc's `file` that begins with `key`; "" where there is none.
std::string proc_value(const std::string& file, const std::string& key) {
    constexpr std::size_t most_bytes = std::size_t{4} << 20;
    const auto text = base::read_text_file("/proc/" + file, most_bytes);
    std::istringstream lines(text ? *text : std::string());
    for (std::string line; std::getline(lines, line);) {
        const std::size_t colon = line.find(':');
        if (line.starts_with(key) && colon != std::string::npos) {
            return base::printable(
                line.substr(std::min(line.find_first_not_of(" \t", colon + 1), line.size())));
        }
    }
    return "";
}

std::uint64_t kibibytes(const std::string& key) {
    std::uint64_t count = 0;
    std::istringstream(proc_value("meminfo", key)) >> count;
    return count << 10U;
}

}  // namespace

Machine this_machine() {
    const std::int64_t targets = hwy::SupportedTargets();
    const std::int64_t best = targets & -targets;  // the lowest bit is the best
    const std::string cpu = proc_value("cpuinfo", "model name");
    return {.cpu = cpu.empty() ? "unknown processor" : cpu,
            .cores = static_cast<int>(std::thread::hardware_concurrency()),
            .memory_bytes = kibibytes("MemTotal"),
            .simd = hwy::TargetName(best),
            .version = SHEARWATER_VERSION};
}

std::string to_line(const Machine& machine) {
    return "shearwater " + machine.version + " on " + machine.cpu + ", " + std::to_string(machine.cores) +
           " cores, " + std::to_string(machine.memory_bytes >> 20U) + " MiB, " + machine.simd;
}

std::string to_json(const Machine& machine) {
    std::ostringstream out;
    deploy::JsonObject object(out);
    object.add("cpu", deploy::quoted(machine.cpu))
        .add("cores", machine.cores)
        .add("memory_bytes", machine.memory_bytes)
        .add("simd", deploy::quoted(machine.simd))
        .add("version", deploy::quoted(machine.version))
        .end();
    return out.str();
}

base::Status check_memory(const std::string& operation, std::uint64_t bytes) {
    const std::uint64_t available = kibibytes("MemAvailable");
    if (available > 0 && bytes > available) {
        return base::error(base::Code::too_large, operation,
                           std::to_string(bytes >> 20U) + " MiB of memory are needed, " +
                               std::to_string(available >> 20U) + " MiB are free");
    }
    return {};
}

}  // namespace shearwater::bench
