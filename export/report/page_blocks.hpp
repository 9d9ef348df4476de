#pragma once
#include <array>
#include <string>

#include "export/report/page_flow.hpp"
#include "export/report/report_content.hpp"

/// The parts of the report's content as they stand on paper. Each leaves the flow below what it has drawn.
namespace aerogram::exporter {

void draw_cover(PageFlow& flow, const Cover& cover);
void draw_facts(PageFlow& flow, const std::vector<Fact>& facts);
void draw_table(PageFlow& flow, const Table& table);
void draw_chart(PageFlow& flow, const Chart& chart);
void draw_plan(PageFlow& flow, const Plan& plan);
/// An arrow with an N. @param north  a unit vector, y up.
void draw_north(Paper& paper, const Vec2& middle, const Vec2& north);
/// A bar of a round length with its length beside it. @param corner  its left end. @param scale  points a metre.
void draw_scale_bar(Paper& paper, const Vec2& corner, double scale, double longest);

/// Where to put round numbers on an axis: about `count` of them in [low, high].
[[nodiscard]] std::vector<double> round_steps(double low, double high, std::size_t count);
/// The same for minutes and seconds.
[[nodiscard]] std::vector<double> clock_steps(double low, double high, std::size_t count);
/// Decimals that tell neighbouring steps apart.
[[nodiscard]] int digits_of_steps(const std::vector<double>& steps);

/// Lines of charts: told apart by colour and, printed in grey, by their dashes.
[[nodiscard]] Stroke chart_stroke(std::size_t line);

}  // namespace aerogram::exporter
