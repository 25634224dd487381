// Mouse, keys and the frame of a window on an X display, one after the other. Movements that were not yet fetched are one:
// the last.
#pragma once
#include <string>
#include <vector>

namespace witherfield::vis {

struct XInput {
  enum class Kind { press, release, motion, wheel, key, resized, exposed, close };
  Kind kind = Kind::exposed;
  int x = 0, y = 0;       ///< pixels from the upper left; resized: width and height
  int button = 0;         ///< 1 left, 2 middle, 3 right; wheel: +1 up, -1 down
  std::string key;        ///< X's name of the key without Shift, letters small
  bool shift = false, control = false;
};

class XEvents {
 public:
  /// Asks the display to send this window's events here. @param display, window as X's own types.
  XEvents(void* display, unsigned long window);
  /// All that has happened, in order; empty when nothing has.
  std::vector<XInput> fetch();
  /// Until something happens, but not longer.
  void wait(double seconds);

 private:
  void* display_;
  unsigned long window_, delete_message_;
};

}  // namespace witherfield::vis
