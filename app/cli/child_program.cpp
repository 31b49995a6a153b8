#include "cli/child_program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace eyrie::cli {
namespace {

constexpr off_t kErrorsKept = 16384;  ///< bytes

std::string tailOf(int file) {
    const off_t size = lseek(file, 0, SEEK_END);
    std::string text(static_cast<std::size_t>(std::clamp<off_t>(size, 0, kErrorsKept)), '\0');
    const ssize_t got = pread(file, text.data(), text.size(), std::max<off_t>(0, size - kErrorsKept));
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, got)));
    return text;
}

/// In the child; only calls that are safe between fork and exec.
[[noreturn]] void become(const char* program, char* const* words, int errors, pid_t parent) {
    setpgid(0, 0);  // Ctrl-C at the terminal is for the parent, who passes it on once
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(127);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    const int nothing = open("/dev/null", O_RDWR);
    dup2(nothing, STDIN_FILENO);
    dup2(nothing, STDOUT_FILENO);
    dup2(errors, STDERR_FILENO);
    execv(program, words);
    _exit(127);
}

}  // namespace

std::string ChildEnd::lastWords() const {
    const std::size_t end = errors.find_last_not_of(" \r\n");
    if (end == std::string::npos) return "ended without a message";
    const std::size_t before = errors.find_last_of("\r\n", end);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    const std::string line = errors.substr(begin, end - begin + 1);
    const std::string name = "eyrie-cli: ";
    return line.starts_with(name) ? line.substr(name.size()) : line;
}

ChildProgram::ChildProgram(const std::vector<std::string>& words, const std::filesystem::path& program) {
    errors_ = memfd_create("errors", MFD_CLOEXEC);
    std::vector<std::string> kept{program == kThisProgram ? "eyrie-cli" : program.filename().string()};
    kept.insert(kept.end(), words.begin(), words.end());
    std::vector<char*> pointers;
    for (std::string& word : kept) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const pid_t parent = getpid();
    signal(SIGCHLD, SIG_DFL);  // who starts us may have it ignored; then nobody learns how a child ended
    process_ = errors_ < 0 ? -1 : fork();
    if (process_ == 0) become(program.c_str(), pointers.data(), errors_, parent);
    if (process_ < 0) {
        const std::string reason = std::strerror(errno);
        if (errors_ >= 0) close(errors_);
        throw Error(ErrorKind::internal, "cannot start another process: " + reason);
    }
}

ChildProgram::~ChildProgram() {
    if (process_ > 0) {
        kill(process_, SIGTERM);
        waitpid(process_, nullptr, 0);
    }
    close(errors_);
}

void ChildProgram::stop() {
    if (process_ > 0) kill(process_, SIGTERM);
}

std::optional<ChildEnd> ChildProgram::ended() {
    int status = 0;
    const pid_t done = process_ > 0 ? waitpid(process_, &status, WNOHANG) : -1;
    if (done == 0 || (done < 0 && errno == EINTR)) return std::nullopt;
    process_ = -1;
    ChildEnd end;
    if (done < 0) end.exit_code = -1;
    if (done > 0 && WIFSIGNALED(status)) end.signal = WTERMSIG(status);
    if (done > 0 && WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
    end.errors = tailOf(errors_);
    return end;
}

}  // namespace eyrie::cli
