// An OpenGL 3.2 core context of EGL on Mesa's surfaceless platform. No VTK, no X.
#pragma once

namespace witherfield::vis {

class EglContext {
 public:
  EglContext() = default;
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// Makes the context and binds it to this thread. @returns false when EGL cannot (no driver, too old).
  bool start();
  void make_current() const;
  bool is_current() const;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace witherfield::vis
