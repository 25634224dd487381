#include "pov/film.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <glm/common.hpp>
#include <string>

#include "pov/tonemap.hpp"
#include "sim/core/colour.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/monotone.hpp"
#include "sim/core/parallel.hpp"

namespace witherfield::pov {
namespace {

glm::dvec3 shown(const glm::vec3& radiance, double exposure) {
  return srgb_levels(tone_map(glm::dvec3(radiance) * exposure));
}

void same_size(const HdrImage& a, const HdrImage& b) {
  if (a.width != b.width || a.height != b.height || a.pixel.empty())
    throw InvalidInput("pictures of a film must have one size: " + std::to_string(a.width) + " x " +
                       std::to_string(a.height) + " and " + std::to_string(b.width) + " x " + std::to_string(b.height));
}

HdrImage mix(const HdrImage& a, const HdrImage& b, double weight) {
  HdrImage out = a;
  for (std::size_t i = 0; i < out.pixel.size(); ++i) out.pixel[i] = glm::mix(a.pixel[i], b.pixel[i], float(weight));
  return out;
}

struct Gap {
  double from = 0, to = 0;
};

/// The known moment nearest to the gap's middle, or the middle itself. Wear goes on ever more slowly, so the middle is
/// that of the roots.
double middle_of(const Gap& gap, std::span<const double> known) {
  const auto root_distance = [&](double m) {
    return std::abs(std::sqrt(m) - 0.5 * (std::sqrt(gap.from) + std::sqrt(gap.to)));
  };
  double best = std::pow(0.5 * (std::sqrt(gap.from) + std::sqrt(gap.to)), 2);
  bool found = false;
  for (double m : known)
    if (m > gap.from && m < gap.to && (!found || root_distance(m) < root_distance(best))) {
      best = m;
      found = true;
    }
  return best;
}

std::size_t number_of(const std::vector<KeyPicture>& keys, double moment) {
  return std::size_t(std::lower_bound(keys.begin(), keys.end(), moment,
                                      [](const KeyPicture& k, double m) { return k.moment < m; }) -
                     keys.begin());
}

}  // namespace

PictureDifference difference(const HdrImage& a, const HdrImage& b, double exposure) {
  same_size(a, b);
  constexpr int kSteps = 20;  // of a level, for the percentile
  std::vector<std::size_t> count(256 * kSteps, 0);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < a.pixel.size(); ++i) {
    const glm::dvec3 d = glm::abs(shown(a.pixel[i], exposure) - shown(b.pixel[i], exposure));
    for (int c = 0; c < 3; ++c) {
      sum += d[c];
      squares += d[c] * d[c];
      ++count[std::min(count.size() - 1, std::size_t(std::ceil(d[c] * kSteps)))];
    }
  }
  const double n = 3.0 * double(a.pixel.size());
  PictureDifference out{sum / n, std::sqrt(squares / n), 0};
  std::size_t step = 0, below = count[0];
  while (double(below) < 0.999 * n && step + 1 < count.size()) below += count[++step];
  out.p999 = double(step) / kSteps;
  return out;
}

KeySet choose_keys(std::span<const double> moments, const PictureAt& picture_at, const KeyOptions& o) {
  if (!(o.bound_rms > 0)) throw InvalidInput("film: the bound of the blend error must be greater than 0 levels");
  if (moments.size() < 2) throw InvalidInput("film: at least 2 moments are needed");
  for (std::size_t i = 0; i < moments.size(); ++i)
    if (!(moments[i] >= 0) || (i > 0 && !(moments[i] > moments[i - 1])))
      throw InvalidInput("film: moments must be 0 or more and increase");
  KeySet set;
  for (double end : {moments.front(), moments.back()}) set.keys.push_back({end, picture_at(end)});
  std::deque<Gap> gaps{{moments.front(), moments.back()}};
  for (; !gaps.empty(); gaps.pop_front()) {
    if (int(set.keys.size()) >= o.max_keys) {
      set.gaps_left = int(gaps.size());
      break;
    }
    const Gap gap = gaps.front();
    KeyPicture middle{middle_of(gap, moments), {}};
    middle.image = picture_at(middle.moment);
    const std::size_t at = number_of(set.keys, middle.moment);
    const HdrImage &a = set.keys[at - 1].image, &b = set.keys[at].image;
    const double before = difference(a, middle.image, o.exposure).rms, behind = difference(middle.image, b, o.exposure).rms;
    const double weight = before + behind > 0 ? before / (before + behind) : 0.5;  // as the even clock will have it
    const PictureDifference error = difference(mix(a, b, weight), middle.image, o.exposure);
    if (error.rms > o.bound_rms) {
      gaps.push_back({gap.from, middle.moment});
      gaps.push_back({middle.moment, gap.to});
    } else if (error.rms > set.blend_error.rms) {
      set.blend_error = error;
      set.worst_moment = middle.moment;
    }
    set.keys.insert(set.keys.begin() + std::ptrdiff_t(at), std::move(middle));
  }
  return set;
}

std::vector<double> film_clock(std::span<const KeyPicture> keys, Pace pace, double exposure) {
  if (keys.size() < 2) throw InvalidInput("film: at least 2 key pictures are needed");
  std::vector<double> clock{0};
  for (std::size_t i = 1; i < keys.size(); ++i)
    clock.push_back(clock.back() + (pace == Pace::even ? difference(keys[i - 1].image, keys[i].image, exposure).rms
                                                       : keys[i].moment - keys[i - 1].moment));
  // Keys that show the same must not fall on the same tick.
  const double least = std::max(1e-6 * clock.back(), 1e-12);
  for (std::size_t i = 1; i < clock.size(); ++i) clock[i] = std::max(clock[i], clock[i - 1] + least);
  for (double& c : clock) c /= clock.back();
  return clock;
}

double moment_at(std::span<const KeyPicture> keys, std::span<const double> clock, double at) {
  const KeyPlace p = place_among(clock, at);
  const auto moment = [&](std::size_t k) {
    return keys[std::clamp<std::size_t>(p.first + k, 1, keys.size()) - 1].moment;
  };
  return monotone_between(p.window, moment(0), moment(1), moment(2), moment(3));
}

HdrImage picture_between(std::span<const KeyPicture> keys, std::span<const double> clock, double at) {
  const KeyPlace p = place_among(clock, at);
  const auto image = [&](std::size_t k) -> const HdrImage& {
    return keys[std::clamp<std::size_t>(p.first + k, 1, keys.size()) - 1].image;
  };
  const std::array<const HdrImage*, 4> y{&image(0), &image(1), &image(2), &image(3)};
  for (const HdrImage* i : y) same_size(*y[1], *i);
  HdrImage out = *y[1];
  parallel_for(out.pixel.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (int c = 0; c < 3; ++c)
        out.pixel[i][c] = float(
            monotone_between(p.window, y[0]->pixel[i][c], y[1]->pixel[i][c], y[2]->pixel[i][c], y[3]->pixel[i][c]));
  });
  return out;
}

void FrameWatch::add(std::span<const std::uint8_t> rgb) {
  if (frames_ > 0 && rgb.size() != last_.size()) throw InvalidInput("frames of a film must have one size");
  if (frames_++ == 0) first_.assign(rgb.begin(), rgb.end());
  std::int64_t step = 0, way = 0;
  std::array<std::size_t, 256> count{};
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const int d = last_.empty() ? 0 : std::abs(int(rgb[i]) - int(last_[i]));
    neighbour_max_ = std::max(neighbour_max_, d);
    step += d;
    ++count[std::size_t(d)];
    way += std::abs(int(rgb[i]) - int(first_[i]));
  }
  const double n = double(std::max<std::size_t>(1, rgb.size())), mean = double(step) / n;
  neighbour_mean_max_ = std::max(neighbour_mean_max_, mean);
  int p999 = 0;
  for (std::size_t below = count[0]; double(below) < 0.999 * double(rgb.size()) && p999 < 255;) below += count[std::size_t(++p999)];
  neighbour_p999_ = std::max(neighbour_p999_, p999);
  path_ += mean;
  from_first_.push_back(double(way) / n);
  highest_ = std::max(highest_, from_first_.back());
  largest_fall_ = std::max(largest_fall_, highest_ - from_first_.back());
  last_.assign(rgb.begin(), rgb.end());
}

double FrameWatch::detour() const { return from_first() > 0 ? path_ / from_first() : 1; }

}  // namespace witherfield::pov
