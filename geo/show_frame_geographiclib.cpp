#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/Math.hpp>
#include <cmath>

#include "geo/show_frame.hpp"

namespace aerogram::geo {

struct ShowFrame::Impl {
    explicit Impl(const ShowOrigin& at)
        : origin(at), tangent_plane(at.ground.latitude_deg, at.ground.longitude_deg, at.ground.height_m) {
        GeographicLib::Math::sincosd(at.heading_deg, sin_heading, cos_heading);  // exact at multiples of 90
    }

    ShowOrigin origin;
    GeographicLib::LocalCartesian tangent_plane;  // east, north, up at the origin
    double sin_heading = 0.0, cos_heading = 1.0;
};

namespace {
bool is_place(const Geodetic& g) {
    return std::abs(g.latitude_deg) <= 90.0 && std::isfinite(g.longitude_deg) && std::isfinite(g.height_m);
}
}  // namespace

ShowFrame::ShowFrame(const ShowOrigin& origin) {
    AEROGRAM_REQUIRE(is_place(origin.ground), origin.ground.latitude_deg, origin.ground.longitude_deg,
                     origin.ground.height_m);
    AEROGRAM_REQUIRE(std::isfinite(origin.heading_deg), origin.heading_deg);
    impl_ = std::make_unique<Impl>(origin);
}
ShowFrame::ShowFrame(const ShowFrame& other) : impl_(std::make_unique<Impl>(*other.impl_)) {
}
ShowFrame& ShowFrame::operator=(const ShowFrame& other) {
    if (this != &other) impl_ = std::make_unique<Impl>(*other.impl_);
    return *this;
}
ShowFrame::~ShowFrame() = default;

const ShowOrigin& ShowFrame::origin() const {
    return impl_->origin;
}

Geodetic ShowFrame::to_geodetic(const Vec3& show_m) const {
    const double s = impl_->sin_heading, c = impl_->cos_heading;
    const double east_m = c * show_m.x + s * show_m.y;
    const double north_m = c * show_m.y - s * show_m.x;
    Geodetic place;
    impl_->tangent_plane.Reverse(east_m, north_m, show_m.z, place.latitude_deg, place.longitude_deg, place.height_m);
    return place;
}

Vec3 ShowFrame::to_show(const Geodetic& place) const {
    const double s = impl_->sin_heading, c = impl_->cos_heading;
    double east_m = 0.0, north_m = 0.0, up_m = 0.0;
    impl_->tangent_plane.Forward(place.latitude_deg, place.longitude_deg, place.height_m, east_m, north_m, up_m);
    return {c * east_m - s * north_m, s * east_m + c * north_m, up_m};
}

double ShowFrame::altitude_above(const Vec3& home_m, const Vec3& show_m) const {
    return to_geodetic(show_m).height_m - to_geodetic(home_m).height_m;
}

Result<double> ShowFrame::amsl_m(const Vec3& show_m) const {
    if (!impl_->origin.geoid_undulation_m) {
        return Error{ErrorCode::invalid_input,
                     "height above mean sea level is not known here: the mission has no show.geoid_undulation_m"};
    }
    return to_geodetic(show_m).height_m - *impl_->origin.geoid_undulation_m;
}

}  // namespace aerogram::geo
