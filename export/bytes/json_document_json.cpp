#include <cmath>
#include <nlohmann/json.hpp>

#include "export/bytes/decimal.hpp"
#include "export/bytes/json_document.hpp"

namespace aerogram::exporter {
namespace {

using Json = nlohmann::json;

const Json& json(const void* value) {
    return *static_cast<const Json*>(value);
}

std::string range_text(double lowest, double highest) {
    std::ostringstream text;
    text << "must be a number from " << lowest << " to " << highest;
    return text.str();
}

}  // namespace

struct JsonDocument::Impl {
    std::string file;
    Json root;
};

JsonDocument::JsonDocument(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
}
JsonDocument::JsonDocument(JsonDocument&&) noexcept = default;
JsonDocument& JsonDocument::operator=(JsonDocument&&) noexcept = default;
JsonDocument::~JsonDocument() = default;

Result<JsonDocument> JsonDocument::parse(std::string file, std::string_view text) {
    try {
        auto impl = std::make_unique<Impl>();
        impl->root = Json::parse(text.begin(), text.end());
        impl->file = std::move(file);
        return JsonDocument(std::move(impl));
    } catch (const Json::parse_error& e) {
        return Error{ErrorCode::invalid_input, file + ": byte " + std::to_string(e.byte) + ": is not JSON"};
    } catch (const Json::exception&) {  // a number beyond double
        return Error{ErrorCode::invalid_input, file + ": holds a number out of range"};
    }
}

const std::string& JsonDocument::file() const {
    return impl_->file;
}

JsonNode JsonDocument::root(JsonProblem& problem) const {
    JsonNode node;
    node.value_ = &impl_->root;
    node.file_ = &impl_->file;
    node.problem_ = &problem;
    return node;
}

JsonNode JsonDocument::pointed(std::string_view pointer, JsonProblem& problem) const {
    JsonNode node = root(problem);
    if (pointer.empty()) return node;
    try {
        const Json::json_pointer parsed{std::string(pointer)};
        if (impl_->root.contains(parsed)) {
            node.value_ = &impl_->root.at(parsed);
            return node;
        }
    } catch (const Json::exception&) {  // no pointer at all: reported like one that leads nowhere
    }
    node.fail("nothing at " + shown(pointer));
    node.value_ = nullptr;
    return node;
}

JsonNode JsonNode::child(const void* value, Step step) const {
    JsonNode node = *this;
    node.value_ = value;
    if (depth_ < kDeepest) node.way_[node.depth_++] = step;
    return node;
}

JsonNode JsonNode::operator[](std::string_view key) const {
    if (value_ == nullptr) return *this;
    if (!is_object()) fail("must be an object");
    const auto member = is_object() ? json(value_).find(key) : json(value_).end();
    if (member == json(value_).end()) {
        const JsonNode missing = child(nullptr, {key});
        missing.fail("is missing");
        return missing;
    }
    return child(&*member, {member.key()});
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
    if (value_ == nullptr) return std::nullopt;
    if (!is_object()) {
        fail("must be an object");
        return std::nullopt;
    }
    const auto member = json(value_).find(key);
    if (member == json(value_).end() || member->is_null()) return std::nullopt;
    return child(&*member, {member.key()});
}

bool JsonNode::has(std::string_view key) const {
    return is_object() && json(value_).contains(key);
}

JsonNode JsonNode::at(std::size_t index) const {
    if (value_ == nullptr) return *this;
    if (index < size()) return child(&json(value_)[index], {{}, index});
    fail("must be an array of at least " + std::to_string(index + 1));
    return child(nullptr, {{}, index});
}

std::size_t JsonNode::size() const {
    if (value_ == nullptr) return 0;
    if (!json(value_).is_array()) fail("must be an array");
    return json(value_).is_array() ? json(value_).size() : 0;
}

bool JsonNode::is_object() const {
    return value_ != nullptr && json(value_).is_object();
}

bool JsonNode::is_null() const {
    return value_ == nullptr || json(value_).is_null();
}

double JsonNode::number(double lowest, double highest) const {
    if (value_ == nullptr) return 0.0;
    const Json& value = json(value_);
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (number >= lowest && number <= highest) return number;
    fail(range_text(lowest, highest));
    return 0.0;
}

std::int64_t JsonNode::whole(std::int64_t lowest, std::int64_t highest) const {
    if (value_ == nullptr) return lowest;
    const Json& value = json(value_);
    const bool fits =
        value.is_number_integer() && (!value.is_number_unsigned() || value.get<std::uint64_t>() <= INT64_MAX);
    const std::int64_t number = fits ? value.get<std::int64_t>() : 0;
    if (fits && number >= lowest && number <= highest) return number;
    fail("must be a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest));
    return lowest;
}

std::string JsonNode::text() const {
    if (value_ == nullptr) return {};
    if (json(value_).is_string()) return json(value_).get<std::string>();
    fail("must be a text");
    return {};
}

bool JsonNode::flag() const {
    if (value_ == nullptr) return false;
    if (json(value_).is_boolean()) return json(value_).get<bool>();
    fail("must be true or false");
    return false;
}

Vec3 JsonNode::point(double limit) const {
    if (value_ == nullptr) return {};
    if (size() != 3) fail("must be [x, y, z]");
    if (size() != 3) return {};
    return {at(0).number(-limit, limit), at(1).number(-limit, limit), at(2).number(-limit, limit)};
}

void JsonNode::fail(const std::string& what) const {
    if (!problem_->found()) problem_->text = where() + ": " + what;
}

std::string JsonNode::where() const {
    std::string text;
    for (std::size_t i = 0; i < depth_; ++i) {
        const Step& step = way_[i];
        if (step.key.empty()) {
            text += '[' + std::to_string(step.index) + ']';
        } else {
            text += (text.empty() ? "" : ".") + std::string(step.key);
        }
    }
    return text.empty() ? *file_ : *file_ + ": " + text;
}

}  // namespace aerogram::exporter
