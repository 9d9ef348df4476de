#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace aerogram::exporter {

/// Reads JSON from front to back and keeps none of it, for files too large for a JsonDocument. Values are asked for as
/// what they should be; the first thing that is otherwise is kept with its byte, and from then on every answer is a
/// default and nothing is called back, so that a reader checks once at its end. Strict JSON (RFC 8259); what is passed
/// over is checked as well. Nothing is allocated but texts that are asked for.
class JsonCursor {
  public:
    static constexpr std::size_t kDeepest = 64;  ///< of values that are passed over

    /// @param text  must outlive this. @param begin  the byte where the value starts.
    explicit JsonCursor(std::string_view text, std::size_t begin = 0)
        : begin_(text.data()), at_(text.data() + begin), end_(text.data() + text.size()), value_(at_) {}

    [[nodiscard]] bool ok() const { return problem_.empty(); }
    /// "byte 17: must be a number", or empty.
    [[nodiscard]] const std::string& problem() const { return problem_; }
    /// Records what is wrong with the value that was read last, unless something was found before.
    void fail(std::string_view what);
    /// The byte that is read next.
    [[nodiscard]] std::size_t byte() const { return static_cast<std::size_t>(at_ - begin_); }

    /// Calls member(std::string_view key) at each member's value, which it must read or pass over. The key lasts until
    /// the call returns.
    template <class Member>
    void object(Member&& member) {
        if (!open('{', "must be an object")) return;
        if (close('}')) return;
        do {
            std::string unescaped;
            const std::string_view key = key_text(unescaped);
            if (!ok()) return;
            member(key);
        } while (ok() && more('}'));
    }
    /// Calls element() at each element, which it must read or pass over.
    template <class Element>
    void array(Element&& element) {
        if (!open('[', "must be a list")) return;
        if (close(']')) return;
        do {
            element();
        } while (ok() && more(']'));
    }

    double number(double lowest, double highest);
    std::int64_t whole(std::int64_t lowest, std::int64_t highest);
    /// Well-formed UTF-8 without control characters. @param longest  bytes, unescaped.
    std::string text(std::size_t longest);
    /// Passes over any value. @returns it as it stands in the text.
    std::string_view skipped();
    /// After the outermost value: nothing but white space may follow.
    void finish();

  private:
    void white() {
        while (at_ != end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t')) ++at_;
    }
    bool open(char bracket, std::string_view complaint);
    bool close(char bracket);
    bool more(char bracket);
    std::string_view key_text(std::string& unescaped);
    /// A string's inside as it stands, and whether it has escapes.
    std::string_view raw_text(bool& escapes);
    std::string unescaped_text(std::string_view raw);
    void skip(std::size_t depth);
    bool literal(std::string_view word);
    bool scan_number(double& value);

    const char* begin_;
    const char* at_;
    const char* end_;
    const char* value_;  ///< where the value that is being read begins
    std::string problem_;
};

}  // namespace aerogram::exporter
