#include <algorithm>
#include <cmath>
#include <limits>

#include "export/report/page_blocks.hpp"
#include "export/report/report_words.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kHeight = 172.0, kPlotLeft = 34.0, kCountsLeft = 50.0, kPlotTop = 28.0, kPlotBottom = 20.0,
                 kSmall = 6.4;
constexpr Ink kBand{0.93, 0.94, 0.955}, kGrid{0.88, 0.90, 0.92}, kBar{0.20, 0.40, 0.64};
constexpr std::size_t kMostPoints = 4000;  ///< of a line on paper

struct Axis {
    double low = 0.0, high = 1.0, from = 0.0, to = 1.0;  // values and where they stand
    [[nodiscard]] double at(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

double width_of_bar(const Chart& chart) {
    return chart.x.size() > 1 ? chart.x[1] - chart.x[0] : 1.0;
}

std::pair<Axis, Axis> axes_of(const Chart& chart, double top) {
    double low = 0.0, high = 0.0;
    const auto take = [&](double value) {
        if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
    };
    for (const ChartLine& line : chart.lines) std::for_each(line.values.begin(), line.values.end(), take);
    for (const ChartLimit& limit : chart.limits) take(limit.value);
    if (high <= low) high = low + 1.0;
    const double above = 0.07 * (high - low), end = chart.x.empty() ? 1.0 : chart.x.back();
    Axis x{chart.x.empty() ? 0.0 : chart.x.front(), chart.bars ? end + width_of_bar(chart) : end,
           kEdge + (chart.bars ? kCountsLeft : kPlotLeft), kPaperWidth - kEdge};
    if (x.high <= x.low) x.high = x.low + 1.0;
    return {x, {low < 0.0 ? low - above : 0.0, high + above, top + kHeight - kPlotBottom, top + kPlotTop}};
}

class ChartDrawing {
  public:
    ChartDrawing(Paper& paper, const Chart& chart, double top) : paper_(paper), chart_(chart), top_(top) {
        std::tie(x_, y_) = axes_of(chart, top);
    }

    void draw() {
        heading();
        bands();
        grid();
        const Vec2 corner{x_.from, y_.to}, size{x_.to - x_.from, y_.from - y_.to};
        paper_.only_inside(corner, size);
        chart_.bars ? bars() : lines();
        paper_.everywhere();
        limits();
        paper_.line({x_.from, y_.from}, {x_.to, y_.from}, {inks::kText, 0.6, Dash::solid});
    }

  private:
    void heading() {
        const std::string unit = chart_.unit == "count" || chart_.unit.empty() ? "" : " (" + chart_.unit + ")";
        paper_.text(cut(paper_, chart_.title + unit, Face::bold, 8.5, kColumn), {kEdge, top_ + 9.0}, Face::bold, 8.5,
                    inks::kText);
        if (chart_.bars) return;
        double x = x_.from;
        for (std::size_t i = 0; i < chart_.lines.size(); ++i) {
            paper_.line({x, top_ + 17.5}, {x + 18.0, top_ + 17.5}, chart_stroke(i));
            const std::string name = cut(paper_, chart_.lines[i].name, Face::regular, 7.0, 140.0);
            paper_.text(name, {x + 22.0, top_ + 20.0}, Face::regular, 7.0, inks::kText);
            x += 38.0 + paper_.width(name, Face::regular, 7.0);
        }
    }

    void bands() {
        double free_from = x_.from;
        for (const ChartBand& band : chart_.bands) {
            const double from = std::clamp(x_.at(band.from), x_.from, x_.to),
                         to = std::clamp(x_.at(band.to), x_.from, x_.to);
            paper_.rectangle({from, y_.to}, {std::max(to - from, 0.6), y_.from - y_.to}, kBand);
            const double middle = 0.5 * (from + to), room = 2.0 * std::min(middle - free_from, x_.to - middle);
            const std::string name =
                cut(paper_, band.name, Face::regular, 5.6, std::min(room, std::max(to - from, 30.0)));
            const double wide = paper_.width(name, Face::regular, 5.6);
            if (wide > room || name == "…") continue;
            paper_.text(name, {middle - 0.5 * wide, y_.to + 6.5}, Face::regular, 5.6, inks::kDim);
            free_from = middle + 0.5 * wide + 3.0;
        }
    }

    void grid() {
        const std::vector<double> up = round_steps(y_.low, y_.high, 5);
        const int digits = digits_of_steps(up);
        for (const double value : up) {
            paper_.line({x_.from, y_.at(value)}, {x_.to, y_.at(value)}, {kGrid, 0.4, Dash::solid});
            const std::string text =
                chart_.bars ? count_text(static_cast<std::size_t>(value)) : fixed_text(value, digits);
            paper_.text(text, {x_.from - 4.0 - paper_.width(text, Face::regular, kSmall), y_.at(value) + 2.2},
                        Face::regular, kSmall, inks::kDim);
        }
        const bool clock = chart_.x_unit == "min:s";
        const std::vector<double> along = clock ? clock_steps(x_.low, x_.high, 12) : round_steps(x_.low, x_.high, 12);
        for (const double value : along) {
            paper_.line({x_.at(value), y_.from}, {x_.at(value), y_.from + 2.5}, {inks::kText, 0.5, Dash::solid});
            const std::string text = clock ? clock_text(value, 0) : fixed_text(value, digits_of_steps(along));
            const double wide = paper_.width(text, Face::regular, kSmall);
            paper_.text(text, {std::min(x_.at(value) - 0.5 * wide, x_.to - wide), y_.from + 9.5}, Face::regular, kSmall,
                        inks::kDim);
        }
        const std::string unit = clock ? "show time, min:s" : chart_.x_unit;
        paper_.text(unit, {x_.to - paper_.width(unit, Face::regular, kSmall), y_.from + 17.0}, Face::regular, kSmall,
                    inks::kDim);
    }

    void bars() {
        const double wide = x_.at(width_of_bar(chart_)) - x_.at(0.0);
        for (std::size_t i = 0; i < chart_.x.size(); ++i) {
            const double high = y_.at(chart_.lines.front().values[i]);
            if (high < y_.from)
                paper_.rectangle({x_.at(chart_.x[i]) + 0.08 * wide, high}, {0.84 * wide, y_.from - high}, kBar);
        }
    }

    void lines() {
        for (std::size_t i = 0; i < chart_.lines.size(); ++i) {
            std::vector<Vec2> way;
            const std::vector<double>& values = chart_.lines[i].values;
            const std::size_t step = values.size() / kMostPoints + 1;
            for (std::size_t at = 0; at < values.size(); at += step) {
                // Of several instants the highest and the lowest, so that no peak is lost.
                const auto end = values.begin() + static_cast<std::ptrdiff_t>(std::min(at + step, values.size()));
                const auto [low, high] = std::minmax_element(values.begin() + static_cast<std::ptrdiff_t>(at), end);
                if (!std::isfinite(*low) || !std::isfinite(*high)) {
                    finish(way, i);
                    continue;
                }
                way.emplace_back(x_.at(chart_.x[at]), y_.at(*high));
                if (low != high) way.emplace_back(x_.at(chart_.x[at]), y_.at(*low));
            }
            finish(way, i);
        }
    }
    void finish(std::vector<Vec2>& way, std::size_t line) {
        if (way.size() > 1) paper_.way(way, chart_stroke(line));
        if (way.size() == 1) paper_.dots(way, 0.6, chart_stroke(line).ink);
        way.clear();
    }

    void limits() {
        std::vector<double> heights;
        for (const ChartLimit& limit : chart_.limits) {
            const double y = y_.at(limit.value);
            const Ink ink =
                chart_.lines.size() > 1 && chart_.limits.size() > 1 ? chart_stroke(limit.line).ink : inks::kBad;
            paper_.line({x_.from, y}, {x_.to, y}, {ink, 0.8, Dash::dashed});
            const std::string text = limit.name + " " + fixed_text(limit.value, 2);
            const double wide = paper_.width(text, Face::bold, kSmall);
            // Beside those before that stand as high.
            const auto beside = std::count_if(heights.begin(), heights.end(),
                                              [&](double other) { return std::abs(y - other) < kSmall + 2.0; });
            const double from = x_.to - wide - 3.0 - 90.0 * static_cast<double>(beside);
            const double baseline = std::max(y - 2.0, y_.to + kSmall);
            paper_.rectangle({from - 1.5, baseline - kSmall + 0.6}, {wide + 3.0, kSmall + 0.8}, {1.0, 1.0, 1.0, 0.88});
            paper_.text(text, {from, baseline}, Face::bold, kSmall, ink);
            heights.push_back(y);
        }
    }

    Paper& paper_;
    const Chart& chart_;
    double top_;
    Axis x_, y_;
};

std::vector<double> multiples(double low, double high, double step) {
    std::vector<double> steps;
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) steps.push_back(k * step);
    return steps;
}

}  // namespace

std::vector<double> round_steps(double low, double high, std::size_t count) {
    const double rough = (high - low) / static_cast<double>(count),
                 power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10.0 * power;
    for (const double factor : {5.0, 2.0, 1.0})
        if (factor * power >= rough) step = factor * power;
    return multiples(low, high, step);
}

std::vector<double> clock_steps(double low, double high, std::size_t count) {
    double step = 1.0;
    for (const double next : {2.0, 5.0, 10.0, 15.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1800.0, 3600.0})
        if ((high - low) / step > static_cast<double>(count)) step = next;
    while ((high - low) / step > static_cast<double>(count)) step *= 2.0;
    return multiples(low, high, step);
}

int digits_of_steps(const std::vector<double>& steps) {
    const double step = steps.size() > 1 ? steps[1] - steps[0] : 1.0;
    return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
}

Stroke chart_stroke(std::size_t line) {
    constexpr std::array<Stroke, 3> kStrokes{{{{0.08, 0.33, 0.63}, 1.0, Dash::solid},
                                              {{0.77, 0.34, 0.02}, 1.0, Dash::solid},
                                              {{0.42, 0.20, 0.60}, 1.1, Dash::dotted}}};
    return kStrokes[line % kStrokes.size()];
}

void draw_chart(PageFlow& flow, const Chart& chart) {
    flow.need(kHeight);
    ChartDrawing(flow.paper(), chart, flow.y()).draw();
    flow.skip(kHeight + 8.0);
}

}  // namespace aerogram::exporter
