#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <sstream>

#include "export/bytes/decimal.hpp"
#include "export/report/report_files.hpp"
#include "sample_report.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

PadSheet sheet_of(std::size_t drones) {
    const Report report = sample::report({drones, 30.0, true, "The end"});
    return pad_sheet(sample::facts(report), report.show_hash, report.certified);
}

TEST(PadSheet, SystemIdsFitIntoAByteAndAreUniqueOnTheirLink) {
    const PadSheet sheet = sheet_of(1234);
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (const PadSheet::Row& row : sheet.rows) {
        EXPECT_GE(row.system_id, 1U);
        EXPECT_LE(row.system_id, 250U);
        EXPECT_TRUE(seen.emplace(row.link, row.system_id).second) << row.drone;
    }
    EXPECT_EQ(seen.size(), 1234U);
    EXPECT_EQ(sheet.rows[249].link, 1U);
    EXPECT_EQ(sheet.rows[249].system_id, 250U);
    EXPECT_EQ(sheet.rows[250].link, 2U);
    EXPECT_EQ(sheet.rows[250].system_id, 1U);
}

TEST(PadSheet, ADroneKeepsItsIdWhenOnlySomeGoOut) {
    OutgoingFacts facts = sample::facts(sample::report({600, 30.0, true, "x"}));
    const PadSheet whole = pad_sheet(facts, "", true);
    facts.drones = {facts.drones[555], facts.drones[16]};
    const PadSheet some = pad_sheet(facts, "", true);
    ASSERT_EQ(some.rows.size(), 2U);
    EXPECT_EQ(some.rows[0].drone, 17U);
    EXPECT_EQ(some.rows[0].system_id, 17U);
    EXPECT_EQ(some.rows[1].drone, 556U);
    EXPECT_EQ(some.rows[1].link, whole.rows[555].link);
    EXPECT_EQ(some.rows[1].system_id, whole.rows[555].system_id);
}

/// Metres north and east of the origin on a sphere of the ellipsoid's local radii: good to a millimetre over 30 m.
Vec2 north_east(const geo::ShowOrigin& origin, double latitude_deg, double longitude_deg) {
    constexpr double kA = 6378137.0, kE2 = 0.00669437999014, kDegree = 3.14159265358979 / 180.0;
    const double s = std::sin(origin.ground.latitude_deg * kDegree), w = std::sqrt(1.0 - kE2 * s * s);
    const double meridian = kA * (1.0 - kE2) / (w * w * w) + origin.ground.height_m,
                 normal = kA / w + origin.ground.height_m;
    return {(latitude_deg - origin.ground.latitude_deg) * kDegree * meridian,
            (longitude_deg - origin.ground.longitude_deg) * kDegree * normal *
                std::cos(origin.ground.latitude_deg * kDegree)};
}

TEST(PadsCsv, PlacesAreWhereTheShowFrameSays) {
    const PadSheet sheet = sheet_of(40);
    std::istringstream lines(pads_csv(sheet));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "pad,drone,name,link,system_id,x_m,y_m,z_m,latitude_deg,longitude_deg,height_m");
    std::size_t read = 0;
    const double heading = sheet.origin->heading_deg * 3.14159265358979 / 180.0;
    for (; std::getline(lines, line); ++read) {
        Fields fields(line, ',');
        std::vector<std::string> f;
        while (const auto next = fields.next()) f.emplace_back(*next);
        ASSERT_EQ(f.size(), 11U) << line;
        const Vec3 home = sheet.rows[read].home_m;
        EXPECT_NEAR(std::stod(f[5]), home.x, 0.0005);
        EXPECT_NEAR(std::stod(f[6]), home.y, 0.0005);
        const Vec2 ne = north_east(*sheet.origin, std::stod(f[8]), std::stod(f[9]));
        EXPECT_NEAR(ne.x, home.y * std::cos(heading) - home.x * std::sin(heading), 0.003) << line;
        EXPECT_NEAR(ne.y, home.y * std::sin(heading) + home.x * std::cos(heading), 0.003) << line;
        EXPECT_NEAR(std::stod(f[10]), sheet.origin->ground.height_m + home.z, 0.002);
    }
    EXPECT_EQ(read, 40U);
}

TEST(PadsCsv, NamesAreQuotedAndPlacesEmptyWithoutOrigin) {
    PadSheet sheet = sheet_of(1);
    sheet.rows[0].name = "lead, \"red\"";
    sheet.rows[0].home_m = {1.5, -2.25, 0.125};
    sheet.origin.reset();
    EXPECT_THAT(pads_csv(sheet), HasSubstr("\n1,1,\"lead, \"\"red\"\"\",1,1,1.500,-2.250,0.125,,,\n"));
}

TEST(PadsPdf, SameSheetSameBytes) {
    for (const std::size_t drones : {1U, 10U, 400U}) {
        const PadSheet sheet = sheet_of(drones);
        const auto pdf = pads_pdf(sheet);
        ASSERT_TRUE(pdf.ok()) << pdf.error().message;
        EXPECT_THAT(*pdf, StartsWith("%PDF-1."));
        EXPECT_EQ(*pdf, *pads_pdf(sheet));
    }
    EXPECT_TRUE(pads_pdf({}).ok());
}

}  // namespace
}  // namespace aerogram::exporter
