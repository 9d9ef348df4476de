#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "geo/contract.hpp"
#include "planner/formation/drawn_solid.hpp"
#include "planner/formation/figure.hpp"
#include "planner/formation/solid_figure.hpp"
#include "planner/mesh/nearest_on_mesh.hpp"
#include "planner/mesh/read_mesh.hpp"

namespace aerogram::planner {
namespace {

Error told(const PartRef& ref, const MeshSource& source, const Error& error) {
    if (error.code == ErrorCode::stopped) return error;
    return {error.code, ref.error(".mesh = \"" + source.file.generic_string() + "\": " + error.message).message};
}

/// The mesh as it stands in the show: z up, its front towards the audience.
Result<TriangleMesh> mesh_of(const PartRef& ref, const MeshSource& source, std::optional<MeshInstant> instant) {
    auto read = read_mesh(source.file, instant);
    if (!read) return told(ref, source, read.error());
    const bool y_up = source.up ? *source.up == UpAxis::y : read->y_up;
    if (y_up) {
        for (Vec3& p : read->mesh.vertices) p = {p.x, -p.z, p.y};
    }
    return std::move(read->mesh);
}

Result<Figure> still_figure(const PartRef& ref, const MeshSource& source, const Run& run) {
    auto mesh = mesh_of(ref, source, std::nullopt);
    if (!mesh) return mesh.error();
    if (source.style != SolidStyle::volume || !source.open_to_surface)
        return solid_figure(ref, std::move(*mesh), source.style, run);
    auto filled = solid_figure(ref, *mesh, SolidStyle::volume, run);
    if (filled || filled.error().code != ErrorCode::invalid_input) return filled;
    auto surface = solid_figure(ref, std::move(*mesh), SolidStyle::surface, run);
    if (surface) surface->note = "shown on its surface, which encloses no volume: " + filled.error().message;
    return surface;
}

/// All frames of an animation that matter to one of them.
struct Frames {
    TriangleMesh first, now;
    MeshBox box;  ///< around all frames
};

Result<Frames> frames_of(const PartRef& ref, const MeshSource& source, const AnimationFrame& frame, const Run& run) {
    Frames out{{}, {}, {Vec3(1e300), Vec3(-1e300)}};
    for (std::size_t index = 0; index < frame.count; ++index) {
        if (run.stopped()) return stopped_error();
        auto mesh = mesh_of(ref, source, MeshInstant{index, frame.count, frame.clip});
        if (!mesh) return mesh.error();
        const MeshBox box = box_of(*mesh);
        out.box.low = glm::min(out.box.low, box.low);
        out.box.high = glm::max(out.box.high, box.high);
        if (index == 0) out.first = *mesh;
        if (index == frame.index) out.now = std::move(*mesh);
    }
    return out;
}

/// Points are found on the first frame and stay at their places of the body.
Result<Figure> animated_figure(const PartRef& ref, const MeshSource& source, const AnimationFrame& frame,
                               const Run& run) {
    if (source.style == SolidStyle::volume)
        return ref.error(".style = \"volume\": an animated mesh has \"surface\" and \"edges\" only");
    auto frames = frames_of(ref, source, frame, run);
    if (!frames) return frames.error();
    AEROGRAM_REQUIRE(frames->first.triangles.size() == frames->now.triangles.size(), source.file);
    const auto first = std::make_shared<const TriangleMesh>(moved(std::move(frames->first), -frames->box.middle()));
    const auto now = std::make_shared<const TriangleMesh>(moved(std::move(frames->now), -frames->box.middle()));
    auto drawn = drawn_solid(ref, first, source.style, frames->box.size(), run);
    if (!drawn) return drawn.error();
    const auto sample = [first, now, sample_first = std::move(drawn->sample)](const Vec3& stretch) {
        const TriangleMesh body = stretched(*first, stretch);
        const NearestOnMesh search(body);
        Points points;
        for (const Vec3& p : sample_first(stretch)) points.push_back(position_of(search.nearest(p), *now) * stretch);
        return points;
    };
    Figure figure = stretchable_figure(frames->box.size(), sample);
    figure.colors_at = colors_of(now);
    return figure;
}

}  // namespace

Result<Figure> mesh_figure(const PartRef& ref, const MeshSource& source, const Run& run) {
    if (source.frame) return animated_figure(ref, source, *source.frame, run);
    return still_figure(ref, source, run);
}

}  // namespace aerogram::planner
