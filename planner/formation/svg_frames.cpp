#include "planner/formation/svg_frames.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>

#include "planner/assignment/assignment.hpp"
#include "planner/drawing/svg.hpp"
#include "planner/formation/area_figure.hpp"
#include "planner/formation/svg_points.hpp"
#include "planner/picture/palette.hpp"

namespace aerogram::planner {
namespace {

/// A frame's layers in the order of the first frame's shapes; their areas are what is to be seen of them.
struct Frame {
    std::vector<InkLayer> layers;
    std::vector<std::string> names;
    Vec2 low{}, high{};
    std::string note;
};

std::string key_of(const std::filesystem::path& file) {
    return ".svg = \"" + file.generic_string() + "\": ";
}

/// "arm", "arm (2)", "shape 3": by id and order.
std::vector<std::string> names_of(const Drawing& drawing, const std::vector<InkLayer>& layers) {
    std::map<std::string, std::size_t> seen;
    std::vector<std::string> names;
    for (const InkLayer& layer : layers) {
        const std::string& id = drawing.shapes[layer.shape].id;
        const std::size_t time = ++seen[id];
        names.push_back(id.empty()  ? "without id, number " + std::to_string(time)
                        : time == 1 ? "\"" + id + "\""
                                    : "\"" + id + "\", number " + std::to_string(time));
    }
    return names;
}

Result<Frame> read_frame(const PartRef& ref, const std::filesystem::path& file) {
    const auto drawing = read_svg(file);
    if (!drawing) return Error{drawing.error().code, ref.error(key_of(file) + drawing.error().message).message};
    const Ink whole = ink_of(*drawing);
    const Ink ink = visible(whole);
    Frame frame;
    frame.layers = ink.layers;
    frame.names = names_of(*drawing, whole.layers);
    std::vector<std::string> kept;  // names follow the whole drawing, so that a hidden shape does not rename others
    std::size_t next = 0;
    for (std::size_t i = 0; i < whole.layers.size(); ++i) {
        if (next < ink.layers.size() && ink.layers[next].shape == whole.layers[i].shape) {
            kept.push_back(frame.names[i]);
            ++next;
        }
    }
    frame.names = std::move(kept);
    frame.low = drawing->view_low;
    frame.high = drawing->view_high;
    for (const std::string& warning : drawing->warnings) frame.note += (frame.note.empty() ? "" : "; ") + warning;
    if (!ink.note.empty()) frame.note += (frame.note.empty() ? "" : "; ") + ink.note;
    return frame;
}

/// The frame's layers in the first one's order.
Status align(const PartRef& ref, const std::filesystem::path& file, const std::filesystem::path& first_file,
             const Frame& first, Frame& frame) {
    const Vec2 size = first.high - first.low, other = frame.high - frame.low;
    if (glm::distance(size, other) > 1e-9 * glm::length(size)) {
        return ref.error(key_of(file) + "its page differs from that of " + first_file.generic_string() +
                         "; all frames of an animation need the same viewBox");
    }
    std::vector<InkLayer> ordered;
    for (const std::string& name : first.names) {
        const auto found = std::find(frame.names.begin(), frame.names.end(), name);
        if (found == frame.names.end()) {
            return ref.error(key_of(file) + "the shape " + name + " of " + first_file.generic_string() +
                             " is not to be seen; all frames of an animation need the same shapes");
        }
        ordered.push_back(frame.layers[static_cast<std::size_t>(found - frame.names.begin())]);
    }
    for (const std::string& name : frame.names) {
        if (std::find(first.names.begin(), first.names.end(), name) != first.names.end()) continue;
        return ref.error(key_of(file) + "the shape " + name + " is not to be seen in " + first_file.generic_string() +
                         "; all frames of an animation need the same shapes");
    }
    frame.layers = std::move(ordered);
    return Done{};
}

Points around_middle(const std::vector<Vec2>& points) {
    const Vec2 sum = std::accumulate(points.begin(), points.end(), Vec2{});
    const Vec2 middle = sum / static_cast<double>(points.size());
    Points out;
    for (const Vec2& p : points) out.emplace_back(p.x - middle.x, 0.0, p.y - middle.y);
    return out;
}

/// The next frame's points of one shape in the order of the slots that fly there.
std::vector<Vec2> followed(const std::vector<Vec2>& before, const std::vector<Vec2>& after, const Run& run) {
    if (before.empty()) return after;
    const auto matched = assign_shortest(around_middle(before), around_middle(after), {}, SeparationMetric{}, run);
    if (!matched) return after;  // stopped
    std::vector<Vec2> out(after.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = after[std::size_t{matched->slot_of[i].value}];
    return out;
}

}  // namespace

Result<Figure> svg_frame_figure(const PartRef& ref, const SvgSource& source, const Run& run) {
    const Size& size = ref.part.size;
    if (!size.width_m && !size.depth_m && !size.height_m) return ref.error(".size_m: an animation needs a size");
    const std::size_t index = source.frame->index;
    auto frames = std::make_shared<std::vector<Frame>>();
    for (std::size_t f = 0; f <= index; ++f) {
        auto frame = read_frame(ref, source.files[f]);
        if (!frame) return frame.error();
        if (frame->layers.empty()) return ref.error(key_of(source.files[f]) + "shows nothing that is lit");
        if (f > 0) {
            const Status aligned = align(ref, source.files[f], source.files.front(), frames->front(), *frame);
            if (!aligned) return aligned.error();
        }
        frames->push_back(std::move(*frame));
    }
    for (Frame& frame : *frames) frame.layers = placed(frame.layers, 0.5 * (frame.low + frame.high), Vec2(1.0));
    const auto share = source.outline_share;
    const std::vector<std::size_t> count = share_out(frames->front().layers, ref.part.drones, share).count;
    Figure figure =
        flat_figure(frames->front().high - frames->front().low, [frames, count, share, run](const Vec2& stretch) {
            std::vector<std::vector<Vec2>> now;
            for (const Frame& frame : *frames) {
                auto next = layer_points(placed(frame.layers, {}, stretch), count, share, {}, run);
                for (std::size_t i = 0; i < now.size(); ++i) next[i] = followed(now[i], next[i], run);
                now = std::move(next);
            }
            std::vector<Vec2> all;
            for (const auto& points : now) all.insert(all.end(), points.begin(), points.end());
            return all;
        });
    for (std::size_t i = 0; i < count.size(); ++i) {
        figure.colors.insert(figure.colors.end(), count[i], frames->back().layers[i].color);
    }
    if (source.palette) figure.colors = reduced(figure.colors, *source.palette);
    figure.note = frames->back().note;
    return figure;
}

}  // namespace aerogram::planner
