#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <memory>
#include <set>
#include <tuple>

#include "planner/text/outline_font.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kNamed = 6;  ///< families that a message lists

struct Deleter {
    void operator()(FcConfig* p) const { FcConfigDestroy(p); }
    void operator()(FcPattern* p) const { FcPatternDestroy(p); }
    void operator()(FcObjectSet* p) const { FcObjectSetDestroy(p); }
    void operator()(FcFontSet* p) const { FcFontSetDestroy(p); }
    void operator()(FcCharSet* p) const { FcCharSetDestroy(p); }
};
template <class T>
using Owned = std::unique_ptr<T, Deleter>;

std::string folded(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// One face of an installed font, under one of its names.
struct Face {
    int weight = 0, slant = 0, width = 0;
    std::string file;
    int index = 0;
    bool whole_variable = false;  ///< a variable font with all its instances at once, whose weight is a range
    /// The regular upright face comes first.
    [[nodiscard]] auto rank() const {
        return std::tuple(std::abs(slant - FC_SLANT_ROMAN), std::abs(weight - FC_WEIGHT_REGULAR),
                          std::abs(width - FC_WIDTH_NORMAL), whole_variable, file, index);
    }
};

int number(FcPattern* pattern, const char* object, int otherwise) {
    double value = otherwise;
    return FcPatternGetDouble(pattern, object, 0, &value) == FcResultMatch ? static_cast<int>(value) : otherwise;
}

Face face_of(FcPattern* pattern) {
    Face face;
    face.weight = number(pattern, FC_WEIGHT, FC_WEIGHT_REGULAR);
    face.slant = number(pattern, FC_SLANT, FC_SLANT_ROMAN);
    face.width = number(pattern, FC_WIDTH, FC_WIDTH_NORMAL);
    FcChar8* file = nullptr;
    if (FcPatternGetString(pattern, FC_FILE, 0, &file) == FcResultMatch) {
        face.file = reinterpret_cast<const char*>(file);
    }
    FcPatternGetInteger(pattern, FC_INDEX, 0, &face.index);
    FcBool variable = FcFalse;
    face.whole_variable = FcPatternGetBool(pattern, FC_VARIABLE, 0, &variable) == FcResultMatch && variable == FcTrue;
    return face;
}

std::vector<std::string> names(FcPattern* pattern, const char* object) {
    std::vector<std::string> out;
    FcChar8* name = nullptr;
    for (int i = 0; FcPatternGetString(pattern, object, i, &name) == FcResultMatch; ++i) {
        out.emplace_back(reinterpret_cast<const char*>(name));
    }
    return out;
}

/// The installed fonts with outlines, and of those the ones that draw `character`.
Owned<FcFontSet> installed(std::optional<char32_t> character) {
    const Owned<FcConfig> config(FcInitLoadConfigAndFonts());
    const Owned<FcPattern> any(FcPatternCreate());
    if (!config || !any) return nullptr;
    FcPatternAddBool(any.get(), FC_OUTLINE, FcTrue);
    if (character) {
        const Owned<FcCharSet> wanted(FcCharSetCreate());
        FcCharSetAddChar(wanted.get(), *character);
        FcPatternAddCharSet(any.get(), FC_CHARSET, wanted.get());
    }
    const Owned<FcObjectSet> objects(FcObjectSetBuild(FC_FAMILY, FC_FULLNAME, FC_FILE, FC_INDEX, FC_WEIGHT, FC_SLANT,
                                                      FC_WIDTH, FC_VARIABLE, static_cast<char*>(nullptr)));
    return Owned<FcFontSet>(FcFontList(config.get(), any.get(), objects.get()));
}

std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t swapped = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, swapped});
        }
    }
    return row.back();
}

Error not_installed(const std::string& name, const std::set<std::string>& families) {
    std::string what = "no installed font has this name";
    if (families.empty()) return {ErrorCode::invalid_input, what + ", nor any other; install fonts-dejavu-core"};
    std::vector<std::string> nearest(families.begin(), families.end());
    const std::string wanted = folded(name.substr(0, 64));
    std::stable_sort(nearest.begin(), nearest.end(), [&](const std::string& a, const std::string& b) {
        return edit_distance(folded(a), wanted) < edit_distance(folded(b), wanted);
    });
    nearest.resize(std::min(nearest.size(), kNamed));
    what += "; the nearest are ";
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        what += (i == 0 ? "\"" : i + 1 == nearest.size() ? " and \"" : ", \"") + nearest[i] + "\"";
    }
    return {ErrorCode::invalid_input, what};
}

}  // namespace

Result<FontFile> installed_font(const std::string& name) {
    const Owned<FcFontSet> fonts = installed(std::nullopt);
    const std::string wanted = folded(name);
    std::set<std::string> families;
    std::optional<Face> best;
    for (int i = 0; fonts && i < fonts->nfont; ++i) {
        FcPattern* pattern = fonts->fonts[i];
        bool named = false;
        for (const std::string& family : names(pattern, FC_FAMILY)) {
            families.insert(family);
            named = named || folded(family) == wanted;
        }
        for (const std::string& full : names(pattern, FC_FULLNAME)) named = named || folded(full) == wanted;
        if (!named) continue;
        const Face face = face_of(pattern);
        if (!best || face.rank() < best->rank()) best = face;
    }
    if (!best) return not_installed(name, families);
    const auto index = static_cast<unsigned>(best->index);
    return FontFile{best->file, best->whole_variable ? index & 0xFFFFU : index};
}

std::optional<std::string> installed_family_with(char32_t character) {
    const Owned<FcFontSet> fonts = installed(character);
    std::optional<std::string> first;
    for (int i = 0; fonts && i < fonts->nfont; ++i) {
        const auto families = names(fonts->fonts[i], FC_FAMILY);  // the first is the one in Latin letters, if any
        if (!families.empty() && (!first || families.front() < *first)) first = families.front();
    }
    return first;
}

}  // namespace aerogram::planner
