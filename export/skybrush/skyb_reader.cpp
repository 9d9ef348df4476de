#include <algorithm>
#include <array>
#include <cmath>

#include "export/bytes/utf8.hpp"
#include "export/outgoing/curve_fit.hpp"
#include "export/skybrush/light_program.hpp"
#include "export/skybrush/skyb.hpp"
#include "export/skybrush/skyb_comment.hpp"
#include "export/skybrush/skyb_layout.hpp"
#include "export/skybrush/skyb_tracks.hpp"
#include "export/skybrush/skyb_trajectory.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kMostLightKeys = 24'000'000;

/// The first block of each type that we know, and where its body begins in the file.
struct Blocks {
    struct Body {
        std::string_view bytes;
        std::size_t offset = 0;
        bool there = false;
        [[nodiscard]] ByteCursor cursor() const { return {bytes, offset}; }
    };
    std::array<Body, 7> first;  ///< by type
    std::vector<std::string_view> comments;
};

/// Header, checksum and the list of blocks.
Result<Blocks> blocks_of(std::string_view file) {
    ByteCursor in(file, 0);
    const std::string_view magic = in.bytes(skyb::kMagic.size());
    const auto version = in.number<std::uint8_t>();
    if (in.ok() && magic != skyb::kMagic) in.complain("does not begin with \"skyb\"", in.at());
    if (in.ok() && version != 1 && version != 2) in.complain("version " + std::to_string(version) + " is not known", 1);
    const std::uint8_t features = version == 2 ? in.number<std::uint8_t>() : std::uint8_t{0};
    if (in.ok() && (features & ~skyb::kFeatureCrc) != 0)
        in.complain("feature bits " + std::to_string(features) + " are not known", 1);
    if (features == skyb::kFeatureCrc) {
        const auto crc = in.number<std::uint32_t>();
        if (in.ok() && crc != skyb::checksum(file)) in.complain("the checksum is not that of the file", 4);
    }
    Blocks blocks;
    while (in.ok() && in.left() > 0) {
        const auto type = in.number<std::uint8_t>();
        if (in.ok() && type == skyb::none) break;  // readers stop here
        const auto length = in.number<std::uint16_t>();
        const std::size_t offset = in.offset();
        const std::string_view body = in.bytes(length);
        if (!in.ok()) break;
        if (type == skyb::comment) blocks.comments.push_back(body);
        if (type < blocks.first.size() && !blocks.first[type].there) blocks.first[type] = {body, offset, true};
    }
    if (in.ok() && !blocks.first[skyb::trajectory].there) in.complain("holds no trajectory");
    if (!in.ok()) return Error{ErrorCode::invalid_input, in.problem()};
    return blocks;
}

/// "drone-001" of "skyb/drone-001.skyb".
std::string stem(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    std::string_view name = path.substr(slash == std::string_view::npos ? 0 : slash + 1);
    if (name.ends_with(".skyb")) name.remove_suffix(5);
    return std::string(name);
}

/// What is read of one file.
struct OneFile {
    RecordedDrone drone;
    ReadSkybTrajectory path;
    std::optional<SkybShowFacts> show;
};

Status read_comment(const Blocks& blocks, OneFile& one) {
    for (const std::string_view text : blocks.comments) {
        auto comment = read_skyb_comment(text);
        if (!comment) return comment.error();
        if (!*comment) continue;
        SkybComment& own = **comment;
        if (!is_plain_utf8(own.show.title) || !is_plain_utf8(own.drone))
            return Error{ErrorCode::invalid_input, "comment: is not plain UTF-8"};
        if (!own.drone.empty()) one.drone.name = own.drone;
        one.drone.home_m = own.home_m;
        one.drone.land_m = own.land_m;
        one.show = std::move(own.show);
        break;
    }
    if (!one.drone.home_m) one.drone.home_m = first_position(one.drone);
    return Done{};
}

Status read_tracks(const Blocks& blocks, RecordedDrone& drone) {
    const auto problem = [](const ByteCursor& in) { return Error{ErrorCode::invalid_input, in.problem()}; };
    if (const Blocks::Body& yaw = blocks.first[skyb::yaw]; yaw.there) {
        ByteCursor in = yaw.cursor();
        drone.tracks.yaw = read_skyb_yaw(in);
        if (!in.ok()) return problem(in);
    }
    if (const Blocks::Body& events = blocks.first[skyb::events]; events.there) {
        ByteCursor in = events.cursor();
        drone.tracks.events = read_skyb_events(in);
        if (!in.ok()) return problem(in);
    }
    const Blocks::Body& lights = blocks.first[skyb::lights];
    if (!lights.there || lights.bytes.empty()) return Done{};
    LightProgramLimits limits;
    limits.until_ms = std::llround((end_s(drone) + 1.0) * 1000.0);
    auto keys = decoded_light_program({reinterpret_cast<const std::uint8_t*>(lights.bytes.data()), lights.bytes.size()},
                                      limits);
    if (!keys) return keys.error();
    drone.tracks.lights = std::move(*keys);
    return Done{};
}

Result<OneFile> read_one(const FileBytes& file) {
    const auto blocks = blocks_of(file.bytes);
    if (!blocks) return blocks.error();
    OneFile one;
    one.drone.name = stem(file.path);
    ByteCursor in = blocks->first[skyb::trajectory].cursor();
    one.path = read_skyb_trajectory(in, one.drone);
    if (!in.ok()) return Error{ErrorCode::invalid_input, in.problem()};
    if (const Status read = read_comment(*blocks, one); !read) return read.error();
    if (const Status read = read_tracks(*blocks, one.drone); !read) return read.error();
    return one;
}

/// Everything about a show that must be the same in all its files, as one text.
std::string identity(const std::optional<SkybShowFacts>& facts) {
    return facts ? skyb_comment({*facts, "", std::nullopt, std::nullopt}) : std::string();
}

/// What rounding may cost, drone by drone the worst.
class RoundingSum {
  public:
    void add(const ReadSkybTrajectory& path) {
        const double off_m = std::sqrt(3.0) * path.scale_mm / 2000.0;
        scale_mm_ = std::max(scale_mm_, path.scale_mm);
        speed_mps_ = std::max(speed_mps_, off_m * path.speed_factor);
        acceleration_mps2_ = std::max(acceleration_mps2_, off_m * path.acceleration_factor);
        jump_mps_ = std::max(jump_mps_, path.linear_jump_mps);
    }
    [[nodiscard]] Rounding stated(const std::optional<Limits>& limits) const {
        Rounding r;
        r.position_m = scale_mm_ / 2000.0;
        r.fit_m = limits ? std::max(0.0, skyb_fit_m(limits->export_margin_m, scale_mm_)) : kFitPosition_m;
        r.speed_allowance_mps = kFitSpeed_mps + speed_mps_;
        const double limit_mps2 = limits.value_or(Limits{}).acceleration_mps2;
        r.acceleration_allowance_mps2 = kFitAccelerationShare * limit_mps2 + acceleration_mps2_;
        r.has_acceleration = jump_mps_ <= 2.0 * r.speed_allowance_mps;  // else corners of straight lines
        return r;
    }

  private:
    int scale_mm_ = 1;
    double speed_mps_ = 0.0, acceleration_mps2_ = 0.0, jump_mps_ = 0.0;
};

void take_facts(RecordedShow& show, const SkybShowFacts& facts) {
    show.title = facts.title;
    show.show_hash = facts.show_hash;
    show.certified = facts.certified;
    show.origin = facts.origin;
    show.limits = facts.limits;
    show.endurance_s = facts.endurance_s;
}

}  // namespace

Result<RecordedShow> read_skyb(std::span<const FileBytes> files) {
    if (files.empty()) return Error{ErrorCode::invalid_input, "skyb: needs at least one file"};
    RecordedShow show;
    show.format = "skyb";
    RoundingSum rounding;
    std::string first_identity;
    std::size_t light_keys = 0;
    for (const FileBytes& file : files) {
        const auto refused = [&](const std::string& what) {
            return Error{ErrorCode::invalid_input, file.path + ": " + what};
        };
        auto one = read_one(file);
        if (!one) return refused(one.error().message);
        std::string own_identity = identity(one->show);
        if (show.drones.empty()) {
            first_identity = std::move(own_identity);
            if (one->show) take_facts(show, *one->show);
        } else if (own_identity != first_identity) {
            return refused("is of another show than " + files.front().path);
        }
        light_keys += one->drone.tracks.lights.size();
        if (light_keys > kMostLightKeys) return refused("too many light changes in this show");
        rounding.add(one->path);
        show.duration_s = std::max(show.duration_s, end_s(one->drone));
        show.drones.push_back(std::move(one->drone));
    }
    show.rounding = rounding.stated(show.limits);
    return show;
}

}  // namespace aerogram::exporter
