#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geo/color.hpp"
#include "geo/result.hpp"
#include "planner/drawing/path.hpp"
#include "planner/drawing/svg_style.hpp"
#include "planner/drawing/xml_tree.hpp"

namespace aerogram::planner {

/// A clipPath where it applies: the area that is to be seen.
struct WalkedClip {
    std::vector<Path> paths;  ///< page units, y down
    std::vector<bool> evenodd;
    std::shared_ptr<const WalkedClip> outer;  ///< clips that hold as well
};

/// A shape as the walk through a drawing found it: page units, y down, curves still curves.
struct WalkedShape {
    std::string_view id;
    std::size_t line = 0;
    Path path;
    bool evenodd = false;
    std::optional<Rgb> fill, stroke;
    double stroke_width = 1.0;
    std::shared_ptr<const WalkedClip> clip;
};

struct WalkedDrawing {
    std::vector<WalkedShape> shapes;  ///< painter's order
    Vec2 low{}, high{};               ///< the page, y down; low = high where the file gives none
};

struct WalkLimits {
    std::size_t depth = 256;
    std::size_t segments = 1'000'000;
    std::size_t visits = 2'000'000;      ///< elements, each as often as `use` shows it
    std::size_t rule_tries = 5'000'000;  ///< of style rules on elements
};

/// Walks through a drawing from its root, following `use`, and resolves styles, units and transforms.
/// Errors: invalid_input ("line 3: ...") when the root is no <svg>, `use` shows itself, or a limit is passed.
Result<WalkedDrawing> walk_svg(const XmlTree& tree, const WalkLimits& limits, DrawingWarnings& warnings);

}  // namespace aerogram::planner
