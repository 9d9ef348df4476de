#include "planner/mesh/ply_header.hpp"

#include <gtest/gtest.h>

#include <string>

namespace aerogram::planner {
namespace {

std::string fault(const std::string& bytes) {
    return fault_of_ply(std::string_view(bytes).substr(0, kLongestPlyHeader), bytes.size());
}

const std::string kFront =
    "ply\r\ncomment by hand\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n";

TEST(PlyHeader, SoundOnesHaveNoFault) {
    EXPECT_EQ(fault(kFront + "end_header\n0 0\n1 1\n"), "");
    EXPECT_EQ(fault(kFront + "end_header\n0 0\n1 1"), "");
    const std::string binary =
        "ply\nformat binary_big_endian 1.0\nobj_info a b\nelement vertex 2\nproperty double x\nproperty uchar red\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    EXPECT_EQ(fault(binary + std::string(2 * 9 + 1, 'x')), "");
    EXPECT_EQ(fault(binary + std::string(2 * 9, 'x')), "is damaged: it ends before its 1 of \"face\"");
    EXPECT_EQ(fault(binary + std::string(2 * 9 - 1, 'x')), "is damaged: it ends before its 2 of \"vertex\"");
}

TEST(PlyHeader, FaultsAreTold) {
    EXPECT_EQ(fault(""), "is damaged: it does not begin like a PLY file");
    EXPECT_EQ(fault("plx\n"), "is damaged: it does not begin like a PLY file");
    EXPECT_EQ(fault("ply"), "is damaged: its header does not end");
    EXPECT_EQ(fault(kFront), "is damaged: its header does not end");
    EXPECT_EQ(fault(kFront + "end_header"), "is damaged: its header does not end");
    EXPECT_EQ(fault("ply\nend_header\n"), "is damaged: its header names no format");
    EXPECT_EQ(fault(kFront + "end_header\n0 0"), "is damaged: it ends before its 2 of \"vertex\"");
    for (const char* line :
         {"element", "element vertex x", "element vertex -1", "element vertex 99999999999999999999", "property quux x",
          "property list float x", "property", "format ascii", "format own 1.0", "word"})
        EXPECT_EQ(fault(kFront + line + "\nend_header\n"),
                  "is damaged: its header has the line \"" + std::string(line) + "\"");
    EXPECT_EQ(fault("ply\nformat ascii 1.0\nproperty float x\n"),
              "is damaged: its header has the line \"property float x\"");
}

TEST(PlyHeader, CountsThatOverflowAreTooMany) {
    EXPECT_EQ(fault("ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\nproperty double x\n"
                    "end_header\n"),
              "is damaged: it ends before its 18446744073709551615 of \"vertex\"");
    EXPECT_EQ(fault("ply\nformat ascii 1.0\nelement vertex 9223372036854775808\nproperty int x\nend_header\n"),
              "is damaged: it ends before its 9223372036854775808 of \"vertex\"");
}

}  // namespace
}  // namespace aerogram::planner
