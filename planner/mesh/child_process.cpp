#include "planner/mesh/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <stop_token>

namespace aerogram::planner {
namespace {

#if defined(__has_feature)
#if __has_feature(address_sanitizer) && !defined(__SANITIZE_ADDRESS__)
#define __SANITIZE_ADDRESS__ 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;  // its shadow maps terabytes, so no limit on mapped memory can be kept
#else
constexpr bool kSanitized = false;
#endif

constexpr int kAnswerFile = 3;   ///< where the child writes
constexpr int kAnswered = 0x5A;  ///< exit status of a child that has written its whole answer

/// What precedes an answer's bytes.
struct Head {
    enum class Kind : std::uint32_t { value, error, violation, out_of_memory };
    Kind kind = Kind::value;
    ErrorCode code = ErrorCode::invalid_input;
    std::uint64_t length = 0;
};

bool write_all(const char* bytes, std::size_t count) {
    while (count > 0) {
        const ssize_t written = ::write(kAnswerFile, bytes, count);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        bytes += written;
        count -= static_cast<std::size_t>(written);
    }
    return true;
}

std::size_t mapped_bytes() {
    unsigned long pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "re")) {
        if (std::fscanf(file, "%lu", &pages) != 1) pages = 0;
        std::fclose(file);
    }
    return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void limit(decltype(RLIMIT_AS) what, std::size_t soft, std::size_t hard) {
    rlimit most{};
    ::getrlimit(what, &most);
    most.rlim_cur = std::min<rlim_t>(soft, most.rlim_max);
    most.rlim_max = std::min<rlim_t>(hard, most.rlim_max);
    ::setrlimit(what, &most);
}

/// Default signals (the program's own handlers are not for us), the terminal's excepted: those are answered by who
/// started us.
void reset_signals() {
    struct sigaction action {};
    for (int number = 1; number < NSIG; ++number) {
        const bool terminal = number == SIGINT || number == SIGQUIT || number == SIGHUP || number == SIGTSTP;
        action.sa_handler = terminal ? SIG_IGN : SIG_DFL;
        ::sigaction(number, &action, nullptr);
    }
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// Only the answer's file stays open; input and output are nowhere.
bool shut_files(int answer_file) {
    const int nowhere = ::open("/dev/null", O_RDWR);
    if (nowhere < 0) return false;
    for (int standard = 0; standard <= 2; ++standard)
        if (::dup2(nowhere, standard) < 0) return false;
    if (answer_file != kAnswerFile && ::dup2(answer_file, kAnswerFile) < 0) return false;
    return ::close_range(kAnswerFile + 1, ~0U, 0) == 0;
}

void hold_to(const ChildLimits& limits) {
    limit(RLIMIT_CORE, 0, 0);
    limit(RLIMIT_FSIZE, 0, 0);
    limit(RLIMIT_CPU, limits.cpu_s, limits.cpu_s + 1);
    if (!kSanitized) {
        const std::size_t most = mapped_bytes() + limits.memory_bytes;
        limit(RLIMIT_AS, most, most);
    }
    ::alarm(limits.wall_s);
}

[[noreturn]] void be_the_child(int answer_file, ::pid_t parent, std::string_view who,
                               const std::function<Result<std::string>()>& work, const ChildLimits& limits) {
    reset_signals();
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent || !shut_files(answer_file)) ::_exit(1);
    hold_to(limits);
    Head head;
    std::string bytes;
    try {
        Result<std::string> answer = work();
        if (answer) {
            bytes = std::move(*answer);
        } else {
            head.kind = Head::Kind::error;
            head.code = answer.error().code;
            bytes = answer.error().message;
        }
    } catch (const ContractViolation& violation) {
        head.kind = Head::Kind::violation;
        bytes = violation.what();
    } catch (const std::bad_alloc&) {
        head.kind = Head::Kind::out_of_memory;
    } catch (const std::exception& thrown) {
        head.kind = Head::Kind::error;
        bytes = std::string(who) + ": " + thrown.what();
    } catch (...) {
        head.kind = Head::Kind::error;
        bytes = std::string(who) + " broke off";
    }
    head.length = bytes.size();
    char front[sizeof head];
    std::memcpy(front, &head, sizeof head);
    const bool said = write_all(front, sizeof front) && write_all(bytes.data(), bytes.size());
    ::_exit(said ? kAnswered : 1);
}

/// Everything the child writes; one byte above `most` is the sign of too much.
std::string read_all(int file, std::size_t most) {
    std::string bytes;
    std::size_t filled = 0;
    while (filled <= most) {
        if (filled == bytes.size())
            bytes.resize(std::min(most + 1, std::max<std::size_t>(std::size_t{1} << 16U, 2 * filled)));
        const ssize_t count = ::read(file, bytes.data() + filled, bytes.size() - filled);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        filled += static_cast<std::size_t>(count);
    }
    bytes.resize(filled);
    return bytes;
}

std::string how_it_ended(int status, const ChildLimits& limits) {
    if (WIFEXITED(status)) return "ended early, with status " + std::to_string(WEXITSTATUS(status));
    switch (WTERMSIG(status)) {
        case SIGALRM:
            return "was ended after " + std::to_string(limits.wall_s) + " s";
        case SIGXCPU:
            return "was ended after " + std::to_string(limits.cpu_s) + " s of processor time";
        case SIGSEGV:
        case SIGBUS:
            return "crashed (invalid memory access)";
        case SIGABRT:
            return "crashed (abort)";
        default:
            return "was ended by signal " + std::to_string(WTERMSIG(status));
    }
}

std::string out_of_memory(const ChildLimits& limits) {
    return "needs more than " + std::to_string(limits.memory_bytes >> 20U) + " MiB of memory";
}

Result<std::string> unpacked(std::string&& answer, std::string_view who, int status, const ChildLimits& limits) {
    const std::string prefix = std::string(who) + " ";
    Head head;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != kAnswered || answer.size() < sizeof head)
        return Error{ErrorCode::invalid_input, prefix + how_it_ended(status, limits)};
    std::memcpy(&head, answer.data(), sizeof head);
    answer.erase(0, sizeof head);
    if (head.length != answer.size()) return Error{ErrorCode::invalid_input, prefix + "gave half an answer"};
    switch (head.kind) {
        case Head::Kind::value:
            return std::move(answer);
        case Head::Kind::error:
            return Error{head.code, std::move(answer)};
        case Head::Kind::violation:
            throw ContractViolation(answer);
        default:
            return Error{ErrorCode::invalid_input, prefix + out_of_memory(limits)};
    }
}

}  // namespace

Result<std::string> run_in_child(std::string_view who, const std::function<Result<std::string>()>& work,
                                 const ChildLimits& limits, const Run& run) {
    if (run.stopped()) return stopped_error();
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
        return Error{ErrorCode::io, std::string(who) + ": no pipe: " + std::strerror(errno)};
    const ::pid_t parent = ::getpid();
    const ::pid_t child = ::fork();
    if (child == 0) be_the_child(ends[1], parent, who, work, limits);
    const int why = errno;
    ::close(ends[1]);
    if (child < 0) {
        ::close(ends[0]);
        return Error{ErrorCode::io, std::string(who) + ": no process: " + std::strerror(why)};
    }
    const std::size_t most = limits.result_bytes + sizeof(Head);
    std::string answer;
    {
        const std::stop_callback end_it(run.stop, [child] { ::kill(child, SIGKILL); });
        answer = read_all(ends[0], most);
        if (answer.size() > most) ::kill(child, SIGKILL);
        siginfo_t ended{};
        while (::waitid(P_PID, static_cast<::id_t>(child), &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
        }
    }
    ::close(ends[0]);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (run.stopped()) return stopped_error();
    if (answer.size() > most)
        return Error{ErrorCode::invalid_input,
                     std::string(who) + " gave more than " + std::to_string(limits.result_bytes >> 20U) + " MiB"};
    return unpacked(std::move(answer), who, status, limits);
}

}  // namespace aerogram::planner
