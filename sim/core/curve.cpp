#include "sim/core/curve.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/errors.hpp"

namespace witherfield {

Curve::Curve(std::vector<std::pair<double, double>> keys, const char* what) {
  const std::string name(what);
  if (keys.size() < 2) throw InvalidInput(name + ": a curve needs at least 2 keys, got " + std::to_string(keys.size()));
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (!std::isfinite(keys[i].first) || !std::isfinite(keys[i].second))
      throw InvalidInput(name + ": key " + std::to_string(i + 1) + " is not a finite number");
    if (i > 0 && keys[i].first <= keys[i - 1].first)
      throw InvalidInput(name + ": time must increase from key to key; key " + std::to_string(i + 1) + " is at " +
                         std::to_string(keys[i].first) + " after " + std::to_string(keys[i - 1].first));
    x_.push_back(keys[i].first);
    y_.push_back(keys[i].second);
  }
  // Slopes by Fritsch & Carlson (1980): average of the secants, limited so that each piece is monotone.
  const std::size_t n = x_.size();
  std::vector<double> secant(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) secant[i] = (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]);
  slope_.assign(n, 0.0);
  slope_[0] = secant[0];
  slope_[n - 1] = secant[n - 2];
  for (std::size_t i = 1; i + 1 < n; ++i)
    slope_[i] = secant[i - 1] * secant[i] <= 0 ? 0.0 : 0.5 * (secant[i - 1] + secant[i]);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (secant[i] == 0) {
      slope_[i] = slope_[i + 1] = 0;
      continue;
    }
    const double a = slope_[i] / secant[i], b = slope_[i + 1] / secant[i], r = std::hypot(a, b);
    if (r > 3) {
      slope_[i] = 3 * a / r * secant[i];
      slope_[i + 1] = 3 * b / r * secant[i];
    }
  }
}

double Curve::operator()(double x) const {
  if (x <= x_.front()) return y_.front();
  if (x >= x_.back()) return y_.back();
  const std::size_t i = std::size_t(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin()) - 1;
  const double h = x_[i + 1] - x_[i], t = (x - x_[i]) / h, s = 1 - t;
  return y_[i] * (1 + 2 * t) * s * s + h * slope_[i] * t * s * s + y_[i + 1] * t * t * (3 - 2 * t) -
         h * slope_[i + 1] * t * t * s;
}

double Curve::derivative(double x) const {
  if (x <= x_.front() || x >= x_.back()) return 0;
  const std::size_t i = std::size_t(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin()) - 1;
  const double h = x_[i + 1] - x_[i], t = (x - x_[i]) / h;
  return (6 * t * (t - 1) * (y_[i] - y_[i + 1])) / h + slope_[i] * (1 - t) * (1 - 3 * t) + slope_[i + 1] * t * (3 * t - 2);
}

bool Curve::non_decreasing() const { return std::is_sorted(y_.begin(), y_.end()); }
bool Curve::non_increasing() const { return std::is_sorted(y_.rbegin(), y_.rend()); }

std::vector<std::pair<double, double>> Curve::keys() const {
  std::vector<std::pair<double, double>> k;
  for (std::size_t i = 0; i < x_.size(); ++i) k.emplace_back(x_[i], y_[i]);
  return k;
}

}  // namespace witherfield
