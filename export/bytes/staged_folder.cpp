#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <utility>

#include "export/bytes/descriptor.hpp"
#include "export/bytes/files.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;

constexpr int kAttempts = 1000;

/// ".show.aerogram-": what staging folders of the destination "show" begin with; the process id and a number follow.
std::string staging_prefix(const fs::path& destination) {
    return "." + destination.filename().string() + ".aerogram-";
}

/// A locked descriptor of the folder, or an invalid one when somebody else holds it or it is gone.
Descriptor locked(const fs::path& folder) {
    Descriptor fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (fd.valid() && ::flock(fd.get(), LOCK_EX | LOCK_NB) != 0) fd.close();
    return fd;
}

/// True when the descriptor is still the folder of that name.
bool is_still(const Descriptor& fd, const fs::path& folder) {
    struct stat open_one {
    }, named_one{};
    return ::fstat(fd.get(), &open_one) == 0 && ::lstat(folder.c_str(), &named_one) == 0 &&
           open_one.st_ino == named_one.st_ino && open_one.st_dev == named_one.st_dev;
}

void remove_leftovers(const fs::path& destination) {
    const std::string prefix = staging_prefix(destination);
    std::error_code ignored;
    for (fs::directory_iterator entry(destination.parent_path(), ignored), end; !ignored && entry != end;
         entry.increment(ignored)) {
        const std::string name = entry->path().filename().string();
        const bool ours = name.starts_with(prefix) && name.size() > prefix.size() &&
                          name.find_first_not_of("0123456789-", prefix.size()) == std::string::npos;
        if (!ours) continue;
        const Descriptor lock = locked(entry->path());
        std::error_code failure;
        if (lock.valid()) fs::remove_all(entry->path(), failure);
    }
}

/// The folder a destination means: absolute, links followed, without a trailing slash.
Result<fs::path> resolved(const fs::path& destination) {
    std::error_code failure;
    fs::path path = fs::weakly_canonical(fs::absolute(destination, failure), failure);
    if (failure) return Error{ErrorCode::io, destination.string() + ": " + failure.message()};
    if (!path.has_filename()) path = path.parent_path();
    if (!path.has_filename()) {
        return Error{ErrorCode::invalid_input, destination.string() + ": cannot be an output folder"};
    }
    return path;
}

Status check_destination(const fs::path& destination) {
    std::error_code failure;
    const fs::file_status status = fs::status(destination, failure);
    if (status.type() == fs::file_type::not_found) return Done{};
    if (failure) return Error{ErrorCode::io, destination.string() + ": " + failure.message()};
    const bool ours = fs::is_directory(status) &&
                      (fs::is_regular_file(destination / kManifestName, failure) || fs::is_empty(destination, failure));
    if (ours) return Done{};
    return Error{ErrorCode::invalid_input,
                 destination.string() +
                     ": exists and is no folder written by aerogram (no manifest.json in it); name "
                     "another one, or remove it"};
}

bool flush(const fs::path& path) {
    const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    return fd.valid() && ::fsync(fd.get()) == 0;
}

int rename_flagged(const fs::path& from, const fs::path& to, unsigned flags) {
    return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags);
}

/// Afterwards `destination` is the new folder, and `staging` the old one or nothing.
Status swap_in(const fs::path& staging, const fs::path& destination) {
    for (int attempt = 0; attempt < 16; ++attempt) {  // the destination may come and go between the two calls
        if (rename_flagged(staging, destination, RENAME_EXCHANGE) == 0) return Done{};
        if (errno == ENOENT && rename_flagged(staging, destination, RENAME_NOREPLACE) == 0) return Done{};
        if (errno == EINVAL) break;
        if (errno != EEXIST && errno != ENOENT) return io_error(destination, "cannot be replaced");
    }
    // File systems without flags: a plain rename is atomic too where the destination does not exist or is empty.
    if (::rename(staging.c_str(), destination.c_str()) == 0) return Done{};
    return io_error(destination,
                    "cannot be replaced in one step on this file system; name a folder that does not exist");
}

}  // namespace

Result<StagedFolder> StagedFolder::beside(const fs::path& destination) {
    const Result<fs::path> target = resolved(destination);
    if (!target) return target.error();
    const Status usable = check_destination(*target);
    if (!usable) return usable.error();
    std::error_code failure;
    fs::create_directories(target->parent_path(), failure);
    if (failure)
        return Error{ErrorCode::io, target->parent_path().string() + ": cannot be created: " + failure.message()};
    remove_leftovers(*target);

    for (int number = 1; number <= kAttempts; ++number) {
        const fs::path staging = target->parent_path() /
                                 (staging_prefix(*target) + std::to_string(::getpid()) + "-" + std::to_string(number));
        if (::mkdir(staging.c_str(), 0777) != 0) {
            if (errno == EEXIST) continue;
            return io_error(staging, "cannot be created");
        }
        Descriptor lock = locked(staging);
        // Between mkdir and the lock another process may have taken the folder for a leftover.
        if (!lock.valid() || !is_still(lock, staging)) {
            ::rmdir(staging.c_str());
            continue;
        }
        StagedFolder folder;
        folder.staging_ = staging;
        folder.destination_ = *target;
        folder.lock_ = lock.release();
        return folder;
    }
    return Error{ErrorCode::io, target->parent_path().string() + ": no folder could be created and locked there"};
}

StagedFolder::StagedFolder(StagedFolder&& other) noexcept
    : staging_(std::exchange(other.staging_, {})),
      destination_(std::exchange(other.destination_, {})),
      lock_(std::exchange(other.lock_, -1)) {
}

StagedFolder& StagedFolder::operator=(StagedFolder&& other) noexcept {
    if (this == &other) return *this;
    discard();
    staging_ = std::exchange(other.staging_, {});
    destination_ = std::exchange(other.destination_, {});
    lock_ = std::exchange(other.lock_, -1);
    return *this;
}

StagedFolder::~StagedFolder() {
    discard();
}

void StagedFolder::discard() noexcept {
    std::error_code ignored;
    if (!staging_.empty()) fs::remove_all(staging_, ignored);
    staging_.clear();
    if (lock_ >= 0) ::close(std::exchange(lock_, -1));
}

Status StagedFolder::commit() {
    AEROGRAM_REQUIRE(!staging_.empty());
    // One flush of the file system instead of an fsync a file: 20 ms against 2 s for 300 files.
    if (::syncfs(lock_) != 0) return io_error(staging_, "cannot be flushed to disk");
    const Status usable = check_destination(destination_);
    if (!usable) return usable;
    const Status swapped = swap_in(staging_, destination_);
    if (!swapped) return swapped;
    const bool kept = flush(destination_.parent_path());
    discard();  // what now has the staging name is the old folder
    if (!kept) return io_error(destination_.parent_path(), "cannot be flushed to disk");
    return Done{};
}

}  // namespace aerogram::exporter
