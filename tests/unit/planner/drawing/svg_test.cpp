#include "planner/drawing/svg.hpp"

#include <filesystem>
#include <fstream>

#include "tests/unit/planner/drawing/drawings.hpp"

namespace aerogram::planner::testing {
namespace {

Bounds box(const DrawnShape& shape) {
    return bounds_of(Region{shape.lines});
}

void expect_box(const DrawnShape& shape, const Vec2& low, const Vec2& high) {
    EXPECT_LT(glm::distance(box(shape).low, low), 1e-6) << box(shape).low.x << ' ' << box(shape).low.y;
    EXPECT_LT(glm::distance(box(shape).high, high), 1e-6) << box(shape).high.x << ' ' << box(shape).high.y;
}

std::string fill_of(const std::string& inside) {
    const DrawnShape shape = only_shape(inside);
    return shape.fill ? hex_from_rgb(*shape.fill) : "none";
}

constexpr const char* kRect = "x='10' y='20' width='30' height='40'";

TEST(Svg, YPointsUpAndTheViewIsTheViewBox) {
    const Drawing drawing = drawing_of(std::string("<rect id='r' ") + kRect + "/>");
    EXPECT_EQ(drawing.view_low, Vec2(0, -100));
    EXPECT_EQ(drawing.view_high, Vec2(100, 0));
    expect_box(drawing.shapes[0], {10, -60}, {40, -20});
    EXPECT_EQ(drawing.shapes[0].id, "r");
    EXPECT_TRUE(drawing.warnings.empty());
}

TEST(Svg, PagesWithoutViewBoxAndStretchedOnes) {
    auto drawing = parse_svg("<svg width='2in' height='96'><rect width='10' height='10'/></svg>");
    EXPECT_EQ(drawing->view_high - drawing->view_low, Vec2(192, 96));
    drawing = parse_svg("<svg><rect x='5' width='10' height='20'/></svg>");
    EXPECT_EQ(drawing->view_high - drawing->view_low, Vec2(10, 20));
    drawing = parse_svg(
        "<svg viewBox='0 0 10 10' width='40' height='20' preserveAspectRatio='none'><rect width='5' "
        "height='5'/></svg>");
    EXPECT_EQ(drawing->view_high - drawing->view_low, Vec2(40, 20));
    expect_box(drawing->shapes[0], {0, -10}, {20, 0});
}

TEST(Svg, TransformsOfEveryKindCompose) {
    const auto moved = [](const std::string& transform) {
        return only_shape("<g transform='" + transform + "'><rect x='1' y='2' width='3' height='4'/></g>");
    };
    expect_box(moved("translate(10,20)"), {11, -26}, {14, -22});
    expect_box(moved("translate(10)"), {11, -6}, {14, -2});
    expect_box(moved("scale(2)"), {2, -12}, {8, -4});
    expect_box(moved("scale(2 3)"), {2, -18}, {8, -6});
    expect_box(moved("rotate(90)"), {-6, -4}, {-2, -1});
    expect_box(moved("rotate(180 10 10)"), {16, -18}, {19, -14});
    expect_box(moved("matrix(1 0 0 1 5 6)"), {6, -12}, {9, -8});
    expect_box(moved("skewX(45)"), {3, -6}, {10, -2});
    expect_box(moved("skewY(45)"), {1, -10}, {4, -3});
    expect_box(moved("translate(10 0) scale(2) translate(1 1)"), {14, -14}, {20, -6});
    const DrawnShape thick =
        only_shape("<g transform='scale(2 8)'><path d='M0 0h1' stroke='red' stroke-width='3'/></g>");
    EXPECT_NEAR(thick.stroke_width, 12.0, 1e-12);
}

TEST(Svg, NestedSvgSymbolsAndUse) {
    expect_box(
        only_shape(
            "<svg x='10' y='10' width='20' height='40' viewBox='0 0 10 10'><rect width='10' height='10'/></svg>"),
        {10, -40}, {30, -20});
    const std::string right =
        "<svg x='10' y='10' width='20' height='40' viewBox='0 0 10 10' "
        "preserveAspectRatio='xMinYMax slice'><rect width='10' height='10'/></svg>";
    expect_box(only_shape(right), {10, -50}, {50, -10});
    const Drawing drawing = drawing_of(
        "<defs><rect id='a' width='5' height='5'/><symbol id='s' viewBox='0 0 1 1'><circle cx='.5' cy='.5' "
        "r='.5'/></symbol>"
        "</defs><use href='#a' x='10' y='20'/><use xlink:href='#s' x='50' y='50' width='10' height='10'/>"
        "<use href='#a' id='third' transform='scale(2)'/>");
    ASSERT_EQ(drawing.shapes.size(), 3U);
    expect_box(drawing.shapes[0], {10, -25}, {15, -20});
    EXPECT_NEAR(box(drawing.shapes[1]).low.x, 50.0, 1e-9);
    EXPECT_NEAR(box(drawing.shapes[1]).size().y, 10.0, 0.05);
    expect_box(drawing.shapes[2], {0, -10}, {10, 0});
}

TEST(Svg, IdsComeFromTheNearestGroup) {
    const Drawing drawing = drawing_of("<g id='arm'><path d='M0 0h9v9z'/><path id='hand' d='M0 0h9v9z'/></g>");
    EXPECT_EQ(drawing.shapes[0].id, "arm");
    EXPECT_EQ(drawing.shapes[1].id, "hand");
}

TEST(Svg, ColoursInEveryNotation) {
    const auto rect = [](const std::string& fill) {
        return fill_of("<rect width='9' height='9' fill='" + fill + "'/>");
    };
    EXPECT_EQ(rect("#f80"), "#ff8800");
    EXPECT_EQ(rect("#12AbEf"), "#12abef");
    EXPECT_EQ(rect("#12abef80"), "#12abef");
    EXPECT_EQ(rect(" rgb( 255, 0 ,128 ) "), "#ff0080");
    EXPECT_EQ(rect("rgb(100%, 50%, 0%)"), "#ff8000");
    EXPECT_EQ(rect("rgba(1,2,3,.5)"), "#010203");
    EXPECT_EQ(rect("hsl(120, 100%, 50%)"), "#00ff00");
    EXPECT_EQ(rect("hsl(210 50% 40%)"), "#336699");
    EXPECT_EQ(rect("RebeccaPurple"), "#000000");  // CSS 4's one name more: a warning, and the inherited black
    EXPECT_EQ(rect("CornflowerBlue"), "#6495ed");
    EXPECT_EQ(rect("lightgoldenrodyellow"), "#fafad2");
}

TEST(Svg, PaintsInheritAndCurrentColour) {
    EXPECT_EQ(fill_of("<g fill='red'><rect width='9' height='9'/></g>"), "#ff0000");
    EXPECT_EQ(fill_of("<g fill='red'><rect width='9' height='9' fill='blue' style='fill:inherit'/></g>"), "#ff0000");
    EXPECT_EQ(fill_of("<g color='lime'><rect width='9' height='9' fill='currentColor'/></g>"), "#00ff00");
    EXPECT_EQ(fill_of("<rect width='9' height='9'/>"), "#000000");
    const DrawnShape line = only_shape("<rect width='9' height='9' fill='none' stroke='#0f0' stroke-width='2'/>");
    EXPECT_FALSE(line.fill.has_value());
    EXPECT_TRUE(line.area.contours.empty());
    EXPECT_EQ(hex_from_rgb(*line.stroke), "#00ff00");
    EXPECT_EQ(line.stroke_width, 2.0);
}

TEST(Svg, WhatIsHiddenIsNotDrawn) {
    const Drawing drawing = drawing_of(
        "<rect id='seen' width='9' height='9'/><rect width='9' height='9' display='none'/>"
        "<rect width='9' height='9' opacity='0'/><g opacity='.2'><g opacity='0.2'><rect width='9' height='9'/></g></g>"
        "<g visibility='hidden'><rect width='9' height='9'/><rect id='back' visibility='visible' width='9' "
        "height='9'/></g>"
        "<g style='display:none'><rect width='9' height='9'/></g><rect fill='transparent' width='9' height='9'/>"
        "<rect fill='none' width='9' height='9'/><defs><rect width='9' height='9'/></defs>");
    ASSERT_EQ(drawing.shapes.size(), 2U);
    EXPECT_EQ(drawing.shapes[0].id, "seen");
    EXPECT_EQ(drawing.shapes[1].id, "back");
}

TEST(Svg, GradientsAreTheMeanOfTheirStopsInLinearLight) {
    const std::string defs =
        "<defs><linearGradient id='a'><stop offset='0' stop-color='red'/><stop offset='1' style='stop-color:#00f'/>"
        "</linearGradient><radialGradient id='b' xlink:href='#a'/></defs>";
    const DrawnShape shape = only_shape(defs + "<rect width='9' height='9' fill='url(#b)'/>");
    EXPECT_NEAR(shape.fill->r, 0.5, 1e-6);
    EXPECT_NEAR(shape.fill->b, 0.5, 1e-6);
    EXPECT_EQ(fill_of("<rect width='9' height='9' fill='url(#none) #123456'/>"), "#123456");
    const Drawing lost = drawing_of("<rect width='9' height='9' fill='url(#none)'/>");
    EXPECT_EQ(all_warnings(lost),
              "line 2: a paint that is no gradient of this file is drawn white; use a plain colour\n");
}

TEST(SvgStyles, AttributeThenSheetThenStyleAttributeThenImportant) {
    const std::string sheet =
        "<style><![CDATA[ /* of an editor */ rect { fill: red } .a{fill:lime} #x, .zzz { fill : blue; }"
        " g.deep > .a { fill: #111213 } svg g .b {fill:#222324} .i{fill:#333435 !important} @media print "
        "{rect{fill:pink}} ]]></style>";
    const auto fill = [&](const std::string& inside) { return fill_of(sheet + inside); };
    EXPECT_EQ(fill("<rect width='9' height='9' fill='white'/>"), "#ff0000");
    EXPECT_EQ(fill("<rect class='q a' width='9' height='9'/>"), "#00ff00");
    EXPECT_EQ(fill("<rect class='a' id='x' width='9' height='9'/>"), "#0000ff");
    EXPECT_EQ(fill("<rect class='a' id='x' style='fill:#010203' width='9' height='9'/>"), "#010203");
    EXPECT_EQ(fill("<rect class='i' style='fill:#010203' width='9' height='9'/>"), "#333435");
    EXPECT_EQ(fill("<g class='deep'><rect class='a' width='9' height='9'/></g>"), "#111213");
    EXPECT_EQ(fill("<g class='deep'><g><rect class='a' width='9' height='9'/></g></g>"), "#00ff00");
    EXPECT_EQ(fill("<g><g><circle class='b' r='9'/></g></g>"), "#222324");
}

TEST(SvgStyles, SelectorsBeyondTheSimpleOnesAreNamed) {
    const Drawing drawing =
        drawing_of("<style>rect:hover{fill:red} @import url(http://x/y.css); </style><rect width='9' height='9'/>");
    EXPECT_EQ(all_warnings(drawing).substr(0, 60), "line 2: parts of the style sheet are not understood: only na");
}

TEST(Svg, FillRulesGiveTheSameInsideToANonzeroRegion) {
    const std::string star = "d='M50 5L79 95L3 40H97L21 95Z'";
    const DrawnShape even = only_shape("<path fill-rule='evenodd' " + star + "/>");
    const DrawnShape nonzero = only_shape("<path " + star + "/>");
    EXPECT_EQ(winding(even.area, {50, -55}), 0);  // the pentagon in the middle
    EXPECT_NE(winding(nonzero.area, {50, -55}), 0);
    EXPECT_NE(winding(even.area, {50, -20}), 0);
    const DrawnShape rings =
        only_shape("<path fill-rule='evenodd' d='M0 0H90V90H0ZM10 10H80V80H10ZM20 20H70V70H20Z'/>");
    EXPECT_NE(winding(rings.area, {5, -5}), 0);
    EXPECT_EQ(winding(rings.area, {15, -15}), 0);
    EXPECT_NE(winding(rings.area, {40, -40}), 0);
}

TEST(Svg, ClipPathsCutAreasAndLines) {
    const std::string clip = "<clipPath id='c'><rect x='20' y='20' width='30' height='30'/></clipPath>";
    const DrawnShape area = only_shape(clip + "<rect width='40' height='40' clip-path='url(#c)'/>");
    EXPECT_NEAR(area_of(area.area), 400.0, 1e-4);
    const DrawnShape line = only_shape(clip + "<g clip-path='url(#c)'><path d='M0 30H90' stroke='red'/></g>");
    EXPECT_NEAR(length_of(line.lines[0], false), 30.0, 1e-4);
    const Drawing gone = drawing_of(clip +
                                    "<rect width='4' height='4' clip-path='url(#c)'/><rect id='r' x='25' y='25' "
                                    "width='4' height='4' clip-path='url(#c)'/>");
    ASSERT_EQ(gone.shapes.size(), 1U);
    EXPECT_NEAR(area_of(gone.shapes[0].area), 16.0, 1e-9);
    EXPECT_TRUE(gone.warnings.empty());
}

TEST(Svg, WhatIsLeftOutIsNamedOnceWithItsFirstLine) {
    const Drawing drawing = drawing_of(
        "<rect width='9' height='9' filter='url(#f)'/>\n<text>Hi</text>\n<text>Ho</text>\n<image "
        "href='http://x/y.png'/>\n"
        "<script>alert(1)</script>\n<use href='other.svg#a'/>\n<rect width='9' height='9' mask='url(#m)'>"
        "<animate attributeName='x'/></rect>\n<path stroke='red' stroke-dasharray='1 2' d='M0 0h9' "
        "marker-end='url(#m)'/><blob/>");
    EXPECT_EQ(all_warnings(drawing),
              "line 2: filters are not applied\n"
              "line 3: text is not drawn; convert it to paths, or use a text source (2 times)\n"
              "line 5: images are not drawn; use an image source\n"
              "line 6: scripts are not run\n"
              "line 7: a link out of the file is not followed; put what it shows into the file\n"
              "line 8: animation inside the file is not played; use numbered files\n"
              "line 8: masks are not applied: all of it is drawn\n"
              "line 9: <blob> is not drawn\n"
              "line 9: dashes are drawn as whole lines\n"
              "line 9: markers are not drawn; convert strokes to paths\n");
}

TEST(Svg, EditorsOwnElementsAndADoctypeWithEntitiesDoNoHarm) {
    const auto drawing = parse_svg(
        "\xef\xbb\xbf<?xml version=\"1.0\"?>\n<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"http://x/svg11.dtd\" "
        "[\n"
        "<!ENTITY ns_svg \"http://www.w3.org/2000/svg\">\n<!ENTITY lol \"&ns_svg;&ns_svg;\"> ]>\n"
        "<svg:svg xmlns:svg=\"&ns_svg;\" viewBox=\"0 0 9 9\"><sodipodi:namedview "
        "id=\"n\"/><metadata><rdf:RDF/></metadata>\n"
        "<svg:g i:extraneous=\"&lol;\"><svg:path id=\"a&amp;b\" d=\"M0 0h9v9z\"/></svg:g></svg:svg>");
    ASSERT_TRUE(drawing.ok()) << drawing.error().message;
    EXPECT_EQ(drawing->shapes[0].id, "a&b");
    EXPECT_TRUE(drawing->warnings.empty()) << all_warnings(*drawing);
}

TEST(Svg, EntitiesAreNotReplaced) {
    const Drawing drawing = drawing_of("<rect style='&st0;' width='9' height='9'/>");
    EXPECT_EQ(all_warnings(drawing), "line 2: entities of the DOCTYPE are not replaced; save the file without them\n");
}

TEST(Svg, ReadsFilesAndNamesWhatIsWrongWithThem) {
    const auto file = std::filesystem::path(::testing::TempDir()) / "aerogram-svg-test.svg";
    std::ofstream(file) << page("<rect width='9' height='9'/>");
    EXPECT_TRUE(read_svg(file).ok());
    std::filesystem::resize_file(file, (std::uintmax_t{64} << 20U) + 1);
    const auto large = read_svg(file);
    EXPECT_EQ(large.error().code, ErrorCode::io);
    EXPECT_EQ(large.error().message, "is larger than 64 MiB");
    std::filesystem::remove(file);
    EXPECT_EQ(read_svg(file).error().code, ErrorCode::io);
}

}  // namespace
}  // namespace aerogram::planner::testing
