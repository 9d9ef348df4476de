#include "export/convert.hpp"

#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "export/bytes/files.hpp"
#include "export/formats.hpp"
#include "export/outgoing/read_show.hpp"
#include "export/verify/judge.hpp"
#include "export/verify_agreement.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;

Error invalid(const fs::path& path, const std::string& what) {
    return {ErrorCode::invalid_input, path.string() + ": " + what};
}

std::string names_of(const std::vector<const Format*>& some) {
    std::string names;
    for (const Format* format : some) names += (names.empty() ? "" : ", ") + std::string(format->name);
    return names;
}

std::vector<const Format*> all_formats() {
    std::vector<const Format*> all;
    for (const Format& format : formats()) all.push_back(&format);
    return all;
}

/// A folder of this call's own beside OUT; gone when the call ends.
class Staging {
  public:
    static Result<Staging> beside(const fs::path& out) {
        std::error_code failure;
        const fs::path parent = fs::absolute(out, failure).lexically_normal().parent_path();
        fs::create_directories(parent, failure);
        std::string name = (parent / ".aerogram-convert-XXXXXX").string();
        if (failure || mkdtemp(name.data()) == nullptr)
            return Error{ErrorCode::io, parent.string() + ": cannot be written"};
        return Staging(name);
    }
    Staging(Staging&& other) noexcept : path_(std::exchange(other.path_, {})) {}
    Staging& operator=(Staging&&) = delete;
    ~Staging() {
        std::error_code ignored;
        if (!path_.empty()) fs::remove_all(path_, ignored);
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    explicit Staging(fs::path path) : path_(std::move(path)) {}
    fs::path path_;
};

std::string without_slash(const fs::path& path) {
    std::string text = path.string();
    while (text.size() > 1 && text.back() == '/') text.pop_back();
    return text;
}

/// Whether OUT names a folder: it is one, or ends with a slash, or its format's name has no ending to go by.
bool is_folder(const fs::path& out) {
    std::error_code failure;
    return fs::is_directory(out, failure) || !out.has_filename();
}

Status check_apart(const fs::path& in, const fs::path& out) {
    std::error_code failure;
    const fs::path from = fs::weakly_canonical(in, failure), to = fs::weakly_canonical(without_slash(out), failure);
    if (from == to) return invalid(out, "is what is converted; name another file");
    const auto inside = std::mismatch(from.begin(), from.end(), to.begin(), to.end());
    if (inside.first == from.end() && fs::is_directory(from, failure))
        return invalid(out, "lies in the folder that is converted; name another place");
    return Done{};
}

Status check_free(const fs::path& out, bool force) {
    std::error_code failure;
    if (!fs::exists(fs::symlink_status(out, failure))) return Done{};
    if (fs::is_directory(out, failure)) {
        if (fs::is_empty(out, failure)) return Done{};
        return invalid(out, "is a folder with files in it; name another, or a file in it");
    }
    if (!fs::is_regular_file(out, failure)) return invalid(out, "is there already and no plain file");
    return force ? Status(Done{}) : invalid(out, "is there already; --force replaces it");
}

/// Where each written file goes.
struct Moves {
    std::vector<std::pair<fs::path, fs::path>> files;  ///< staged (relative), final
    bool folder = false;                               ///< OUT itself is made from a staged folder
    fs::path staged_folder;
};

Result<Moves> moves_of(const std::vector<std::string>& written, const fs::path& out, bool force) {
    Moves moves;
    if (written.size() == 1) {
        const fs::path file = is_folder(out) ? out / fs::path(written.front()).filename() : out;
        if (const Status is_free = check_free(file, force); !is_free) return is_free.error();
        moves.files = {{written.front(), file}};
        return moves;
    }
    if (out.has_extension() && !is_folder(out)) {
        return invalid(out, "this makes " + std::to_string(written.size()) +
                                " files: name a folder (ending with / or without a dot)");
    }
    if (const Status is_free = check_free(out, false); !is_free) return is_free.error();
    moves.folder = true;
    moves.staged_folder = fs::path(written.front()).parent_path();
    for (const std::string& path : written) {
        if (fs::path(path).parent_path() != moves.staged_folder)
            return invalid(out, "files of several folders cannot be put into one");
        moves.files.emplace_back(path, fs::path(without_slash(out)) / fs::path(path).filename());
    }
    return moves;
}

Status put_in_place(const fs::path& staging, const Moves& moves, const fs::path& out) {
    std::error_code failure;
    const auto failed = [&](const fs::path& path) {
        return Error{ErrorCode::io, path.string() + ": " + failure.message()};
    };
    if (!moves.folder) {
        const auto& [from, to] = moves.files.front();
        fs::create_directories(fs::absolute(to).parent_path(), failure);
        fs::rename(staging / from, to, failure);
        return failure ? Status(failed(to)) : Status(Done{});
    }
    const fs::path to = without_slash(out);
    fs::remove(to, failure);  // only an empty folder can be there
    failure.clear();
    fs::rename(moves.staged_folder.empty() ? staging : staging / moves.staged_folder, to, failure);
    return failure ? Status(failed(to)) : Status(Done{});
}

class Conversion {
  public:
    Conversion(const OpenedShow& given, const ReadShow& show, const Format& format, const fs::path& out,
               const ConvertOptions& options, const Run& run)
        : given_(given), show_(show), format_(format), out_(out), options_(options), run_(run) {}

    Result<Converted> run() {
        auto staging = Staging::beside(without_slash(out_));
        if (!staging) return staging.error();
        Seal seal{given_.show.show_hash.value_or(""), given_.show.certified.value_or(false)};
        auto moves = write(staging->path(), seal);
        if (!moves) return moves.error();
        auto read = read_back(staging->path(), *moves);
        if (!read) return read.error();
        if (seal.certified) {
            auto broken = broken_limit(*read);
            if (!broken) return broken.error();
            if (!broken->empty()) {
                result_.no_longer_certified = *broken;
                seal.certified = false;
                moves = write(staging->path(), seal);
                if (!moves) return moves.error();
                read = read_back(staging->path(), *moves);
                if (!read) return read.error();
            }
        }
        if (const Status same = compare(*read); !same) return same.error();
        if (run_.stopped()) return stopped_error();
        if (const Status placed = put_in_place(staging->path(), *moves, out_); !placed) return placed.error();
        for (const auto& move : moves->files) result_.files.push_back(move.second);
        result_.certified = seal.certified;
        tell(*read);
        return std::move(result_);
    }

  private:
    Result<Moves> write(const fs::path& folder, const Seal& seal) {
        const auto written = format_.write(show_, seal, folder, run_);
        if (!written) return written.error();
        if (run_.stopped()) return stopped_error();
        return moves_of(*written, out_, options_.force);
    }

    Result<RecordedShow> read_back(const fs::path& folder, const Moves& moves) {
        std::vector<FileBytes> files;
        for (const auto& [staged, final] : moves.files) {
            auto bytes = read_file(folder / staged);
            if (!bytes) return bytes.error();
            files.push_back({staged.generic_string(), std::move(*bytes)});
        }
        auto read = format_.read(files);
        const auto broken = [](const std::string& what) {
            return Error{ErrorCode::io, "what was written " + what + "; this is a bug, please report it"};
        };
        if (!read) return broken("cannot be read back: " + read.error().message);
        if (const Status sound = well_formed(*read); !sound)
            return broken("is not well formed: " + sound.error().message);
        if (read->drones.size() != show_.drones()) return broken("holds another number of drones");
        for (std::size_t i = 0; i < show_.drones(); ++i)
            if (read->drones[i].name != show_.facts().drones[i].name) return broken("names other drones");
        return read;
    }

    /// The first limit that the show breaks as it was written, or empty.
    Result<std::string> broken_limit(RecordedShow read) const {
        const OutgoingFacts& facts = show_.facts();
        Points homes_m;
        for (const OutgoingDrone& drone : facts.drones) homes_m.push_back(drone.home_m);
        state_missing_places(read, homes_m);
        JudgeAgainst against;
        against.limits = facts.limits;
        against.airspace = facts.airspace;
        against.origin = facts.origin;
        against.endurance_s = facts.endurance_s;
        const auto judgement = judge(read, against, run_);
        if (!judgement) return judgement.error();
        for (const Finding& finding : judgement->findings) {
            if (finding.held) continue;
            std::array<char, 160> text{};
            std::snprintf(text.data(), text.size(), "%s %.4f, limit %.4f", finding.rule.c_str(), finding.worst,
                          finding.limit);
            return std::string(text.data());
        }
        return judgement->problems.empty() ? std::string() : judgement->problems.front();
    }

    Status compare(const RecordedShow& read) {
        result_.stated_m = stated_accuracy_m(show_, read);
        if (!read.timed) {
            RecordedShow reference = given_.show;
            if (show_.facts().drones.size() != reference.drones.size()) return Done{};
            const Problems problems = disagreement_of_shows(reference, read, show_.facts().limits,
                                                            show_.facts().origin.value_or(geo::ShowOrigin{}));
            return problems.empty() ? Status(Done{})
                                    : Error{ErrorCode::infeasible, out_.string() + ": " + problems.front()};
        }
        const auto off = deviation(show_, read, run_);
        if (!off) return off.error();
        result_.deviation = *off;
        if (off->position_m <= result_.stated_m) return Done{};
        std::array<char, 200> text{};
        std::snprintf(text.data(), text.size(),
                      ": would be up to %.4f m from what was read (drone %zu, at %.2f s); %s states %.4f m",
                      off->position_m, show_.facts().drones[off->drone].number, off->time_s,
                      std::string(format_.name).c_str(), result_.stated_m);
        return Error{ErrorCode::infeasible, out_.string() + text.data()};
    }

    void tell(const RecordedShow& read) {
        result_.from = given_.format->name;
        result_.format = format_.name;
        result_.drones = show_.drones();
        result_.timed = read.timed;
        result_.completed_from = given_.completed_from;
        result_.assumed = show_.assumed();
        result_.lost = losses(show_, given_.show, read, format_.lost);
        const std::size_t all = given_.show.drones.size();
        if (all > show_.drones())
            result_.lost.push_back(std::to_string(all - show_.drones()) + " drones, as was asked");
    }

    const OpenedShow& given_;
    const ReadShow& show_;
    const Format& format_;
    const fs::path& out_;
    const ConvertOptions& options_;
    const Run& run_;
    Converted result_;
};

}  // namespace

Result<const Format*> format_for(const fs::path& out, const std::string& format) {
    if (!format.empty()) {
        if (const Format* found = find_format(format)) return found;
        return Error{ErrorCode::invalid_input,
                     "no format is named \"" + format + "\"; there are: " + names_of(all_formats())};
    }
    const std::string name = fs::path(without_slash(out)).filename().string();
    std::string ending = fs::path(name).extension().string();
    if (!ending.empty()) ending.erase(0, 1);
    for (const std::string& word : {ending, name}) {
        if (const Format* found = find_format(word)) return found;
    }
    constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kKnown{
        {{"csv.zip", "csv"}, {"bin", "trajectories"}, {"plan", "qgc"}, {"html", "preview"}, {"glb", "gltf"}}};
    for (const auto& [end, of] : kKnown) {
        if (!name.ends_with(end)) continue;
        if (const Format* found = find_format(of)) return found;
    }
    std::vector<const Format*> likely;
    for (const Format& each : formats())
        if (each.recognises(name, "")) likely.push_back(&each);
    if (likely.size() == 1) return likely.front();
    return invalid(out, "the name does not tell the format; add --format with one of: " +
                            names_of(likely.empty() ? all_formats() : likely));
}

Result<Converted> convert(const fs::path& in, const fs::path& out, const ConvertOptions& options, const Run& run) {
    if (const Status apart = check_apart(in, out); !apart) return apart.error();
    const auto format = format_for(out, options.format);
    if (!format) return format.error();
    auto given = open_show(in, run);
    if (!given) return given.error();
    const auto show = ReadShow::of(given->show, {options.drones, options.origin, options.exporting}, run);
    if (!show) return show.error().code == ErrorCode::stopped ? show.error() : invalid(in, show.error().message);
    const std::string why = (*format)->unsuited(**show);
    if (!why.empty()) return invalid(in, "cannot become " + std::string((*format)->name) + ": " + why);
    return Conversion(*given, **show, **format, out, options, run).run();
}

}  // namespace aerogram::exporter
