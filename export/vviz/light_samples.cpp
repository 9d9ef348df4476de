#include "export/vviz/light_samples.hpp"

#include <algorithm>

namespace aerogram::exporter {
namespace {

constexpr std::int64_t kFadeStep = 10, kMostSteps = 32;

Rgb mixed(const Rgb& a, const Rgb& b, double u) {
    return {a.r + u * (b.r - a.r), a.g + u * (b.g - a.g), a.b + u * (b.b - a.b)};
}

class Samples {
  public:
    void add(std::int64_t frame, const Rgb& color) {
        const LightSample sample{frame, quantised(color)};
        const LightSample replaced = samples_.empty() ? sample : samples_.back();
        while (!samples_.empty() && samples_.back().frame >= frame) samples_.pop_back();  // the later counts
        // A jump: what it replaces was the colour until then, and samples before it may have been left out for it.
        if (replaced.frame == frame && replaced.color != sample.color && !samples_.empty() &&
            samples_.back().frame < frame - 1)
            samples_.push_back({frame - 1, replaced.color});
        const std::size_t n = samples_.size();
        const bool level = n > 1 && samples_[n - 1].color == sample.color && samples_[n - 2].color == sample.color;
        if (level) samples_.pop_back();
        samples_.push_back(sample);
    }
    std::vector<LightSample> taken() {
        const std::size_t n = samples_.size();
        if (n > 1 && samples_[n - 1].color == samples_[n - 2].color) samples_.pop_back();  // held to the end anyway
        return std::move(samples_);
    }

  private:
    std::vector<LightSample> samples_;
};

}  // namespace

std::vector<LightSample> light_samples(std::span<const LightKey> keys, Millis frame_ms) {
    Samples samples;
    const auto frame_of = [&](Millis time_ms) { return (std::max<Millis>(time_ms, 0) + frame_ms / 2) / frame_ms; };
    samples.add(0, {0.0, 0.0, 0.0});
    if (!keys.empty() && frame_of(keys[0].time_ms) > 1) samples.add(frame_of(keys[0].time_ms) - 1, {0.0, 0.0, 0.0});
    for (std::size_t k = 0; k < keys.size(); ++k) {
        const std::int64_t from = frame_of(keys[k].time_ms);
        samples.add(from, keys[k].color);
        if (k + 1 == keys.size()) break;
        const std::int64_t to = frame_of(keys[k + 1].time_ms);
        if (!keys[k].fade) {
            if (to - 1 > from) samples.add(to - 1, keys[k].color);
            continue;
        }
        const std::int64_t steps = std::min(kMostSteps, (to - from + kFadeStep - 1) / kFadeStep);
        for (std::int64_t step = 1; step < steps; ++step) {
            const std::int64_t frame = from + (to - from) * step / steps;
            const double u = static_cast<double>(frame - from) / static_cast<double>(to - from);
            samples.add(frame, mixed(keys[k].color, keys[k + 1].color, u));
        }
    }
    return samples.taken();
}

}  // namespace aerogram::exporter
