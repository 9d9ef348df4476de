#include "export/skybrush/light_program.hpp"

#include <algorithm>
#include <optional>

#include "export/skybrush/light_loops.hpp"

namespace aerogram::exporter {
namespace {

constexpr unsigned kEnd = 0x00, kSleep = 0x02, kSet = 0x04, kFade = 0x08, kLoop = 0x0C, kLoopEnd = 0x0D;
/// Added to kSet and kFade: how the colour is spelt.
constexpr unsigned kRgb = 0, kGray = 1, kBlack = 2, kWhite = 3;

constexpr Rgb8 kDark{0, 0, 0};

/// A step of a program: what the lamp does for some ticks.
struct Step {
    bool fade = false;
    Rgb8 color;
    std::uint64_t ticks = 0;
};

/// Steps without idle ones, and their bytes.
class Writer {
  public:
    void set(const Rgb8& color, std::uint64_t ticks) { add({false, color, ticks}); }
    void fade(const Rgb8& from, const Rgb8& to, std::uint64_t ticks) {
        if (from == to) return set(to, ticks);
        if (now() != from) set(from, 0);
        add({true, to, ticks});
    }
    /// @returns the program, which ends with black.
    std::vector<std::uint8_t> finished() && {
        std::vector<std::string> texts;
        texts.reserve(steps_.size());
        for (const Step& step : steps_) texts.push_back(text_of(step));
        std::vector<std::uint8_t> program = looped(texts);
        program.insert(program.end(), {kSet + kBlack, 1, kEnd});
        return program;
    }

  private:
    [[nodiscard]] Rgb8 now() const { return steps_.empty() ? kDark : steps_.back().color; }

    /// What holds the colour that is shown already lengthens the step before.
    void add(const Step& step) {
        const bool holds = !step.fade && !steps_.empty() && !steps_.back().fade && steps_.back().color == step.color;
        if (holds) {
            steps_.back().ticks += step.ticks;
        } else {
            steps_.push_back(step);
        }
    }

    static std::string text_of(const Step& step) {
        const Rgb8& c = step.color;
        const bool gray = c.r == c.g && c.g == c.b;
        const unsigned spelling = !gray ? kRgb : c.r == 0 ? kBlack : c.r == 255 ? kWhite : kGray;
        std::string text;
        const auto put = [&](std::uint64_t byte) { text += static_cast<char>(byte); };
        put((step.fade ? kFade : kSet) + spelling);
        if (spelling == kRgb || spelling == kGray) put(c.r);
        if (spelling == kRgb) put(c.g), put(c.b);
        std::uint64_t ticks = step.ticks;
        for (; ticks > 0x7F; ticks >>= 7U) put(0x80U | (ticks & 0x7FU));
        put(ticks);
        return text;
    }

    std::vector<Step> steps_;
};

std::uint64_t tick_of(Millis time_ms) {
    return static_cast<std::uint64_t>(std::max<Millis>(0, time_ms + kLightTickMs / 2) / kLightTickMs);
}

}  // namespace

std::vector<std::uint8_t> light_program(std::span<const LightKey> keys, Millis duration_ms) {
    Writer out;
    std::uint64_t tick = 0;
    if (!keys.empty() && tick_of(keys.front().time_ms) > 0) {
        tick = tick_of(keys.front().time_ms);
        out.set(kDark, tick);
    }
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const bool last = i + 1 == keys.size();
        const std::uint64_t end = std::max(tick, tick_of(last ? duration_ms : keys[i + 1].time_ms));
        const Rgb8 color = quantised(keys[i].color);
        if (end == tick) continue;
        if (keys[i].fade && !last) {
            out.fade(color, quantised(keys[i + 1].color), end - tick);
        } else {
            out.set(color, end - tick);
        }
        tick = end;
    }
    return std::move(out).finished();
}

namespace {

class Decoder {
  public:
    Decoder(std::span<const std::uint8_t> program, const LightProgramLimits& limits)
        : program_(program), limits_(limits), until_(tick_of(limits.until_ms)) {}

    Result<std::vector<LightKey>> run() {
        for (std::size_t count = 0; tick_ <= until_; ++count) {
            if (count == limits_.instructions) return error_at(at_, "too many instructions");
            const std::size_t start = at_;
            const std::uint8_t code = byte();
            if (!problem_ && code == kEnd) return std::move(keys_);
            if (!problem_) execute(code, start);
            if (problem_) return error_at(start, *problem_);
        }
        return std::move(keys_);
    }

  private:
    struct Loop {
        std::size_t body = 0;
        std::uint32_t rounds_left = 0;  ///< 0: for ever
    };

    static Error error_at(std::size_t place, const std::string& what) {
        return {ErrorCode::invalid_input, "light program, byte " + std::to_string(place) + ": " + what};
    }

    void execute(std::uint8_t code, std::size_t start) {
        if (code == kSleep) {
            tick_ += leb128();
        } else if (code >= kSet && code <= kSet + kWhite) {
            const Rgb8 color = spelt(code - kSet);
            show(color, false);
            tick_ += leb128();
        } else if (code >= kFade && code <= kFade + kWhite) {
            const Rgb8 target = spelt(code - kFade);
            const std::uint64_t ticks = leb128();
            if (ticks > 0) show(now_, true);
            tick_ += ticks;
            show(target, false);
        } else if (code == kLoop) {
            const std::uint8_t rounds = byte();
            if (loops_.size() == limits_.loop_depth)
                problem_ = "loops deeper than " + std::to_string(limits_.loop_depth);
            loops_.push_back({at_, rounds});
        } else if (code == kLoopEnd) {
            end_loop();
        } else {
            at_ = start;
            problem_ = "instruction " + std::to_string(code) + " is not known";
        }
    }

    void end_loop() {
        if (loops_.empty()) {
            problem_ = "a loop ends that never began";
        } else if (loops_.back().rounds_left == 1) {
            loops_.pop_back();
        } else {
            if (loops_.back().rounds_left > 1) --loops_.back().rounds_left;
            at_ = loops_.back().body;
        }
    }

    /// From now on `color`; keys that change nothing are left out.
    void show(const Rgb8& color, bool fade) {
        now_ = color;
        const LightKey key{static_cast<Millis>(tick_) * kLightTickMs, from_8bit(color), fade};
        if (!keys_.empty() && !fade && !keys_.back().fade && keys_.back().color == key.color) return;
        // A key at the instant of its predecessor replaces it, unless a fade still runs towards that one.
        const bool target = keys_.size() >= 2 && keys_[keys_.size() - 2].fade;
        const bool same_time = !keys_.empty() && keys_.back().time_ms == key.time_ms;
        if (same_time && (!target || keys_.back().color == key.color)) {
            keys_.back() = key;
        } else {
            keys_.push_back(key);
        }
    }

    Rgb8 spelt(unsigned spelling) {
        if (spelling == kBlack) return kDark;
        if (spelling == kWhite) return {255, 255, 255};
        const std::uint8_t first = byte();
        if (spelling == kGray) return {first, first, first};
        const std::uint8_t second = byte();
        return {first, second, byte()};
    }

    std::uint8_t byte() {
        if (at_ < program_.size()) return program_[at_++];
        problem_ = "the program is cut off";
        return 0;
    }

    std::uint64_t leb128() {
        std::uint64_t value = 0;
        for (unsigned shift = 0; shift < 35; shift += 7) {
            const std::uint8_t next = byte();
            value |= std::uint64_t{next & 0x7Fu} << shift;
            if (next < 0x80) return value;
        }
        problem_ = "a duration is longer than 32 bits";
        return 0;
    }

    std::span<const std::uint8_t> program_;
    LightProgramLimits limits_;
    std::uint64_t until_;
    std::size_t at_ = 0;
    std::uint64_t tick_ = 0;
    Rgb8 now_ = kDark;
    std::vector<Loop> loops_;
    std::vector<LightKey> keys_;
    std::optional<std::string> problem_;
};

}  // namespace

Result<std::vector<LightKey>> decoded_light_program(std::span<const std::uint8_t> program,
                                                    const LightProgramLimits& limits) {
    return Decoder(program, limits).run();
}

}  // namespace aerogram::exporter
