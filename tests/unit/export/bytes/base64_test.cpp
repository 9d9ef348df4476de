#include "export/bytes/base64.hpp"

#include <gtest/gtest.h>

namespace aerogram::exporter {
namespace {

std::vector<std::uint8_t> bytes_of(std::string_view text) {
    return {text.begin(), text.end()};
}

/// RFC 4648, section 10.
TEST(Base64, GivesTheVectorsOfTheStandard) {
    const std::pair<std::string_view, std::string_view> vectors[] = {
        {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"foobar", "Zm9vYmFy"}};
    for (const auto& [plain, coded] : vectors) {
        EXPECT_EQ(base64_encoded(bytes_of(plain)), coded);
        EXPECT_EQ(base64_decoded(coded), bytes_of(plain));
    }
}

TEST(Base64, RoundTripsAllByteValuesAtAllLengths) {
    std::vector<std::uint8_t> bytes;
    for (unsigned i = 0; i < 300; ++i) {
        EXPECT_EQ(base64_decoded(base64_encoded(bytes)), bytes) << i;
        bytes.push_back(static_cast<std::uint8_t>(i * 37 + i / 256));
    }
}

TEST(Base64, PaddingMayBeMissingButNotMisplaced) {
    EXPECT_EQ(base64_decoded("Zg"), bytes_of("f"));
    for (const char* text : {"Z", "Zg=a", "=", "Zm9v=", "Zm 9", "Zm9-", "Zg==="})
        EXPECT_FALSE(base64_decoded(text)) << text;
}

}  // namespace
}  // namespace aerogram::exporter
