#include <algorithm>

#include "export/report/page_blocks.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kTitleSize = 19.0, kLongTitleSize = 13.5, kReasonSize = 9.0;
constexpr std::size_t kMostReasonLines = 12;  ///< on the first page; all of them stand before the rules

void draw_title(PageFlow& flow, const Cover& cover) {
    Paper& paper = flow.paper();
    paper.text("FLIGHT VALIDATION REPORT", {kEdge, flow.y() + 9.0}, Face::bold, 8.5, inks::kDim);
    flow.skip(16.0);
    const bool long_name = wrapped(paper, cover.title, Face::bold, kTitleSize, kColumn, 3).size() > 2;
    const double size = long_name ? kLongTitleSize : kTitleSize;
    for (const std::string& line : wrapped(paper, cover.title, Face::bold, size, kColumn, 3)) {
        paper.text(line, {kEdge, flow.y() + size}, Face::bold, size, inks::kText);
        flow.skip(1.25 * size);
    }
    flow.skip(6.0);
}

/// The reasons' lines, as many as there is room for.
std::vector<std::string> reason_lines(const Paper& paper, const Cover& cover) {
    std::vector<std::string> lines;
    for (const std::string& reason : cover.reasons) {
        bool first = true;
        for (const std::string& line : wrapped(paper, reason, Face::regular, kReasonSize, kColumn - 40.0, 3)) {
            lines.push_back((first ? "• " : "  ") + line);
            first = false;
        }
    }
    if (lines.size() > kMostReasonLines) {
        lines.resize(kMostReasonLines - 1);
        lines.emplace_back("• … all reasons: section Rules");
    }
    return lines;
}

void draw_verdict(PageFlow& flow, const Cover& cover) {
    Paper& paper = flow.paper();
    const Ink ink = cover.certified ? inks::kGood : inks::kBad;
    const std::vector<std::string> reasons = reason_lines(paper, cover);
    const std::vector<std::string> statement = wrapped(paper, cover.statement, Face::regular, 8.5, kColumn - 32.0);
    double size = 30.0;
    while (paper.width(cover.verdict, Face::bold, size) > kColumn - 32.0) size -= 0.5;
    const double lines = static_cast<double>(reasons.size()) * 1.35 * kReasonSize;
    const double height = 18.0 + size + 8.0 + 12.0 * static_cast<double>(statement.size()) + lines + 6.0;
    const double top = flow.y();
    paper.rectangle({kEdge, top}, {kColumn, height}, cover.certified ? inks::kGoodGround : inks::kBadGround);
    paper.rectangle({kEdge, top}, {6.0, height}, ink);
    double y = top + 12.0 + 0.8 * size;
    paper.text(cover.verdict, {kEdge + 18.0, y}, Face::bold, size, ink);
    y += 20.0;
    for (const std::string& line : statement) {
        paper.text(line, {kEdge + 18.0, y}, Face::regular, 8.5, inks::kText);
        y += 12.0;
    }
    y += 1.0;
    for (const std::string& line : reasons) {
        paper.text(line, {kEdge + 18.0, y}, Face::regular, kReasonSize, inks::kBad);
        y += 1.35 * kReasonSize;
    }
    flow.skip(height + 12.0);
}

void draw_hash(PageFlow& flow, const Cover& cover) {
    Paper& paper = flow.paper();
    paper.text("Show hash", {kEdge, flow.y() + 11.0}, Face::regular, 8.0, inks::kDim);
    for (const std::string& line : cover.hash) {
        paper.text(line, {kEdge + 80.0, flow.y() + 11.5}, Face::mono, 12.0, inks::kText);
        flow.skip(16.5);
    }
    flow.skip(8.0);
}

void draw_figures(PageFlow& flow, const Cover& cover) {
    constexpr std::size_t kAcross = 3;
    constexpr double kGap = 9.0, kHeight = 56.0;
    const double wide = (kColumn - kGap * (kAcross - 1)) / kAcross;
    Paper& paper = flow.paper();
    for (std::size_t i = 0; i < cover.figures.size(); ++i) {
        const Figure& figure = cover.figures[i];
        const double x = kEdge + static_cast<double>(i % kAcross) * (wide + kGap);
        const double y = flow.y() + static_cast<double>(i / kAcross) * (kHeight + kGap);
        paper.frame({x, y}, {wide, kHeight}, {inks::kRule, 0.7, Dash::solid});
        paper.text(cut(paper, figure.name, Face::regular, 7.5, wide - 14.0), {x + 7.0, y + 12.0}, Face::regular, 7.5,
                   inks::kDim);
        double size = 15.0;
        while (size > 7.0 && paper.width(figure.value, Face::bold, size) > wide - 14.0) size -= 0.5;
        paper.text(figure.value, {x + 7.0, y + 29.0}, Face::bold, size, inks::kText);
        double below = y + 40.0;
        for (const std::string& line : wrapped(paper, figure.detail, Face::regular, 6.8, wide - 14.0, 2)) {
            paper.text(line, {x + 7.0, below}, Face::regular, 6.8, inks::kDim);
            below += 9.0;
        }
    }
    const double rows = static_cast<double>((cover.figures.size() + kAcross - 1) / kAcross);
    flow.skip(rows * (kHeight + kGap) + 6.0);
}

/// Names and values in one column of the page; returns its height.
double draw_column(Paper& paper, const std::vector<Fact>& facts, const Vec2& corner, double name_wide, double wide) {
    constexpr double kSize = 7.8;
    double y = corner.y;
    for (const Fact& fact : facts) {
        paper.text(cut(paper, fact.name, Face::regular, kSize, name_wide - 4.0), {corner.x, y + kSize}, Face::regular,
                   kSize, inks::kDim);
        for (const std::string& line : wrapped(paper, fact.value, Face::regular, kSize, wide - name_wide, 4)) {
            paper.text(line, {corner.x + name_wide, y + kSize}, Face::regular, kSize, inks::kText);
            y += 1.4 * kSize;
        }
    }
    return y - corner.y;
}

void draw_signing(PageFlow& flow, const Cover& cover) {
    Paper& paper = flow.paper();
    constexpr double kHeight = 66.0;
    const double wide = 0.5 * (kColumn - 24.0), top = flow.y() + std::max(0.0, flow.room() - kHeight - 30.0);
    if (cover.signing.empty()) {
        paper.frame({kEdge, top + 14.0}, {kColumn, 40.0}, {inks::kBad, 1.2, Dash::solid});
        const std::string text = "Not to be signed: this show may not be flown.";
        paper.text(text, {0.5 * (kPaperWidth - paper.width(text, Face::bold, 11.0)), top + 38.0}, Face::bold, 11.0,
                   inks::kBad);
        return;
    }
    paper.text("I have read this report and fly the show as it states.", {kEdge, top + 2.0}, Face::regular, 8.0,
               inks::kText);
    for (std::size_t i = 0; i < cover.signing.size(); ++i) {
        const double x = kEdge + static_cast<double>(i % 2) * (wide + 24.0);
        const double y = top + 34.0 + static_cast<double>(i / 2) * 36.0;
        paper.line({x, y}, {x + wide, y}, {inks::kText, 0.7, Dash::solid});
        paper.text(cover.signing[i], {x, y + 9.0}, Face::regular, 7.0, inks::kDim);
    }
}

}  // namespace

void draw_cover(PageFlow& flow, const Cover& cover) {
    draw_title(flow, cover);
    draw_verdict(flow, cover);
    draw_hash(flow, cover);
    draw_figures(flow, cover);
    const double left = 0.58 * kColumn, top = flow.y() + 13.0;
    Paper& paper = flow.paper();
    paper.text("Show", {kEdge, flow.y() + 8.0}, Face::bold, 8.5, inks::kText);
    paper.text("Limits", {kEdge + left + 14.0, flow.y() + 8.0}, Face::bold, 8.5, inks::kText);
    const double shows = draw_column(paper, cover.facts, {kEdge, top}, 76.0, left - 6.0);
    const double limits = draw_column(paper, cover.limits, {kEdge + left + 14.0, top}, 92.0, kColumn - left - 14.0);
    flow.skip(13.0 + std::max(shows, limits) + 8.0);
    paper.text("What else this report says", {kEdge, flow.y() + 8.0}, Face::bold, 8.5, inks::kText);
    flow.skip(13.0 + draw_column(paper, cover.findings, {kEdge, flow.y() + 13.0}, 128.0, kColumn));
    draw_signing(flow, cover);
}

}  // namespace aerogram::exporter
