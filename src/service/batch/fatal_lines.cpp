#include "fatal_lines.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <string>

namespace turnwright::service {
namespace {

constexpr std::array kFaults{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

// A signal handler finds only what is global.
std::string notes_file;
std::array<struct sigaction, kFaults.size()> before;
thread_local std::atomic<const FatalLines::Line*> computed = nullptr;

// Calls only what POSIX allows in a handler.
void note(int signal, siginfo_t* info, void*) {
  const auto* line = computed.load();
  if (line && info->si_code != SI_USER) {
    const int file =
        ::open(notes_file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    [[maybe_unused]] const auto written = ::write(file, line, sizeof *line);
  }
  // A fault comes again when this returns, and then ends the process; what was sent does
  // not.
  for (std::size_t i = 0; i < kFaults.size(); ++i)
    if (kFaults[i] == signal) ::sigaction(signal, &before[i], nullptr);
  if (info->si_code <= 0) ::raise(signal);
}

}  // namespace

FatalLines::FatalLines(const std::filesystem::path& notes) {
  notes_file = std::filesystem::absolute(notes).string();
  struct sigaction action {};
  action.sa_sigaction = note;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  for (std::size_t i = 0; i < kFaults.size(); ++i)
    ::sigaction(kFaults[i], &action, &before[i]);
}

FatalLines::~FatalLines() {
  for (std::size_t i = 0; i < kFaults.size(); ++i)
    ::sigaction(kFaults[i], &before[i], nullptr);
}

std::vector<FatalLines::Line> FatalLines::noted(const std::filesystem::path& notes) {
  std::ifstream in(notes, std::ios::binary);
  std::vector<Line> lines;
  for (Line line; in.read(reinterpret_cast<char*>(&line), sizeof line);)
    lines.push_back(line);
  return lines;
}

FatalLines::Computing::Computing(const Line& line) : line_(line) {
  const stack_t own{.ss_sp = stack_.data(), .ss_flags = 0, .ss_size = stack_.size()};
  ::sigaltstack(&own, &before_);
  computed = &line_;
}

FatalLines::Computing::~Computing() {
  computed = nullptr;
  ::sigaltstack(&before_, nullptr);
}

}  // namespace turnwright::service
