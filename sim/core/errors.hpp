// Errors that cross a layer. Each carries the process exit code that the command line uses for it.
// The message must say where (file:line or function), what value, which range, which unit.
#pragma once
#include <stdexcept>
#include <string>

namespace witherfield {

class Error : public std::runtime_error {
 public:
  Error(const std::string& message, int exit_code) : std::runtime_error(message), exit_code_(exit_code) {}
  int exit_code() const noexcept { return exit_code_; }

 private:
  int exit_code_;
};

/// The user's input is wrong (scene key, value, DEM content, command line). Exit code 2.
class InvalidInput : public Error {
 public:
  explicit InvalidInput(const std::string& message) : Error(message, 2) {}
};

/// A file or a program could not be opened, read, written or run. Exit code 3.
class IoFailure : public Error {
 public:
  explicit IoFailure(const std::string& message) : Error(message, 3) {}
};

/// A numerical method failed (did not converge, not finite). Exit code 4.
class SolverFailure : public Error {
 public:
  explicit SolverFailure(const std::string& message) : Error(message, 4) {}
};

}  // namespace witherfield
