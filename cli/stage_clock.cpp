#include <fstream>
#include <sstream>

#include "cli/run_record.hpp"

namespace witherfield::cli {
namespace {

/// "VmHWM:   123456 kB" of the process, in MiB; 0 where there is no such file.
double peak_memory_MiB() {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line))
    if (line.rfind("VmHWM:", 0) == 0) {
      double kib = 0;
      std::istringstream(line.substr(6)) >> kib;
      return kib / 1024;
    }
  return 0;
}

/// Lets the kernel count the peak anew (proc(5), clear_refs 5). Where that is not allowed the peak is that of
/// the run so far.
void reset_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << '5';
}

}  // namespace

void StageClock::start(const std::string& name) {
  const auto now = std::chrono::steady_clock::now();
  if (!name_.empty())
    stages_.push_back({name_, std::chrono::duration<double>(now - start_).count(), peak_memory_MiB()});
  name_ = name;
  start_ = now;
  reset_peak_memory();
}

}  // namespace witherfield::cli
