#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geo/vec3.hpp"

/// Strict reading of JSON objects for the *_json.cpp files: every complaint names the field's path. `Json` is the JSON
/// library's value type, so that this header needs none of its headers.
namespace aerogram::exporter::json {

/// What is wrong with a field; never leaves the *_json.cpp file.
class BadField : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

template <class Json>
class Field {
  public:
    Field(const Json& value, std::string path) : value_(value), path_(std::move(path)) {}

    [[nodiscard]] const std::string& path() const { return path_; }
    [[noreturn]] void wrong(std::string_view what) const { throw BadField(path_ + " " + std::string(what)); }

    [[nodiscard]] Field operator[](const std::string& key) const {
        const std::string path = path_.empty() ? key : path_ + "." + key;
        const auto found = value_.is_object() ? value_.find(key) : value_.end();
        if (found == value_.end()) throw BadField(path + " is missing");
        return {*found, path};
    }
    [[nodiscard]] bool has(const std::string& key) const { return value_.is_object() && value_.contains(key); }
    [[nodiscard]] bool is_null() const { return value_.is_null(); }

    [[nodiscard]] std::string text() const {
        if (!value_.is_string()) wrong("must be a string");
        return value_.template get<std::string>();
    }
    [[nodiscard]] bool truth() const {
        if (!value_.is_boolean()) wrong("must be true or false");
        return value_.template get<bool>();
    }
    [[nodiscard]] double number(double least = -1e9, double largest = 1e9) const {
        if (!value_.is_number()) wrong("must be a number");
        const double x = value_.template get<double>();
        if (!(x >= least && x <= largest)) wrong("is out of range");
        return x;
    }
    [[nodiscard]] std::optional<double> number_or_null() const {
        return is_null() ? std::nullopt : std::optional(number());
    }
    [[nodiscard]] std::uint64_t count() const {
        if (!value_.is_number_unsigned()) wrong("must be a whole number, not negative");
        return value_.template get<std::uint64_t>();
    }
    /// Lower-case hex digits of a SHA-256.
    [[nodiscard]] std::string sha256() const {
        const std::string digits = text();
        if (digits.size() != 64 || digits.find_first_not_of("0123456789abcdef") != std::string::npos) {
            wrong("must be 64 lower-case hex digits");
        }
        return digits;
    }
    [[nodiscard]] std::vector<Field> list() const {
        if (!value_.is_array()) wrong("must be a list");
        std::vector<Field> fields;
        for (const Json& element : value_) {
            fields.emplace_back(element, path_ + "[" + std::to_string(fields.size() + 1) + "]");
        }
        return fields;
    }
    /// A list of exactly n numbers.
    [[nodiscard]] std::vector<double> numbers(std::size_t n) const {
        const std::vector<Field> fields = list();
        if (fields.size() != n) wrong("must be a list of " + std::to_string(n) + " numbers");
        std::vector<double> values;
        for (const Field& field : fields) values.push_back(field.number());
        return values;
    }
    [[nodiscard]] std::vector<std::string> texts() const {
        std::vector<std::string> values;
        for (const Field& field : list()) values.push_back(field.text());
        return values;
    }

  private:
    const Json& value_;
    std::string path_;
};

}  // namespace aerogram::exporter::json
