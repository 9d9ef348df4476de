#include "planner/formation/figure.hpp"

#include <variant>

namespace aerogram::planner {

Error PartRef::error(const std::string& what) const {
    return {ErrorCode::invalid_input, mission.at(part.line, key + what)};
}

Result<Figure> figure_of(const PartRef& ref, const Run& run) {
    if (const auto* text = std::get_if<TextSource>(&ref.part.source)) return text_figure(ref, *text, run);
    if (const auto* image = std::get_if<ImageSource>(&ref.part.source)) return image_figure(ref, *image, run);
    if (const auto* svg = std::get_if<SvgSource>(&ref.part.source)) return svg_figure(ref, *svg, run);
    if (const auto* csv = std::get_if<CsvSource>(&ref.part.source)) return csv_figure(ref, *csv);
    if (const auto* shape = std::get_if<ShapeSource>(&ref.part.source)) return shape_figure(ref, *shape, run);
    if (const auto* sketch = std::get_if<SketchSource>(&ref.part.source)) return sketch_figure(ref, *sketch, run);
    if (const auto* mesh = std::get_if<MeshSource>(&ref.part.source)) return mesh_figure(ref, *mesh, run);
    return ref.error(": source not in this version");
}

}  // namespace aerogram::planner
