#include "export/exact/payload_cursor.hpp"

#include "export/bytes/utf8.hpp"

namespace aerogram::exporter::trajectories {

std::size_t PayloadCursor::count(std::size_t bytes_each) {
    const std::size_t n = number<std::uint32_t>();
    if (n > left() / bytes_each) complain("a count that the file cannot hold", 4);
    return ok() ? n : 0;
}

std::uint32_t PayloadCursor::one_of(std::uint32_t choices) {
    const auto value = number<std::uint32_t>();
    if (value >= choices) complain("must be below " + std::to_string(choices), 4);
    return ok() ? value : 0;
}

std::string PayloadCursor::text() {
    const std::size_t size = count(1);
    std::string s(bytes(size));
    if (!is_plain_utf8(s)) complain("text that is not plain UTF-8", size);
    const std::string_view fill = bytes((4 - size % 4) % 4);
    if (fill.find_first_not_of('\0') != std::string_view::npos) complain("padding that is not 0", fill.size());
    return s;
}

Vec2 PayloadCursor::place() {
    const double x = real(kLargestCoordinate_m);
    return {x, real(kLargestCoordinate_m)};
}

geo::Polygon PayloadCursor::polygon(bool may_be_empty) {
    geo::Polygon outline(count(2 * sizeof(double)));
    if (outline.size() < 3 && !(outline.empty() && may_be_empty)) complain("a polygon of fewer than 3 points", 4);
    for (Vec2& p : outline) p = place();
    return outline;
}

std::vector<Vec3> PayloadCursor::points(std::size_t n) {
    std::vector<Vec3> list(n);
    for (Vec3& p : list) {
        p.x = scalar(kLargestCoordinate_m);
        p.y = scalar(kLargestCoordinate_m);
        p.z = scalar(kLargestCoordinate_m);
    }
    return list;
}

}  // namespace aerogram::exporter::trajectories
