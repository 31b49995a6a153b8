#include "cli/loaded_program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

#include "cli/program.h"
#include "io/atomic_file.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace eyrie::test {
namespace {

constexpr std::size_t kLongestRequest = 64 * 1024;  ///< bytes

/// In a process that was split off for one command.
[[noreturn]] void become(std::vector<std::string> words) {
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
        const std::string& path = words[stream == STDOUT_FILENO ? 0 : 1];
        const int file = open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
        dup2(file, stream);
        close(file);
    }
    words[1] = "eyrie-cli";
    std::vector<char*> arguments;
    for (std::size_t i = 1; i < words.size(); ++i) arguments.push_back(words[i].data());
    arguments.push_back(nullptr);
    std::exit(cli::runProgram(static_cast<int>(arguments.size()) - 1, arguments.data()));
}

/// Does what comes through the socket until nobody is at its other end. A request is words that each end with a zero:
/// the files for what is printed and for errors, then the arguments; the answer is the status of waitpid().
[[noreturn]] void serve(int socket) {
    std::array<char, kLongestRequest> request;
    for (;;) {
        const ssize_t size = recv(socket, request.data(), request.size(), 0);
        if (size <= 0) _exit(0);
        std::vector<std::string> words;
        for (ssize_t at = 0; at < size; at += static_cast<ssize_t>(words.back().size()) + 1)
            words.emplace_back(request.data() + at);
        const pid_t child = fork();
        if (child == 0) {
            close(socket);
            become(std::move(words));
        }
        int status = -1;
        if (child > 0) waitpid(child, &status, 0);
        send(socket, &status, sizeof status, MSG_NOSIGNAL);
    }
}

/// A process that splits one off for each command. It is made before the first test, since only a process that never
/// had a second thread can be copied.
class Splitter : public testing::Environment {
 public:
    void SetUp() override {
        std::array<int, 2> ends{};
        if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
            throw std::runtime_error("cannot make a pair of sockets");
        std::fflush(nullptr);
        process_ = fork();
        if (process_ == 0) {
            close(ends[0]);
            serve(ends[1]);
        }
        close(ends[1]);
        socket_ = ends[0];
    }
    void TearDown() override {
        close(socket_);
        waitpid(process_, nullptr, 0);
    }
    ProcessResult run(const std::vector<std::string>& arguments) const {
        const TemporaryFolder folder;
        std::string request = (folder / "out").string() + '\0' + (folder / "err").string() + '\0';
        for (const std::string& argument : arguments) request += argument + '\0';
        int status = -1;
        if (request.size() > kLongestRequest || send(socket_, request.data(), request.size(), MSG_NOSIGNAL) < 0 ||
            recv(socket_, &status, sizeof status, 0) != sizeof status || status == -1)
            throw std::runtime_error("cannot split a process off");
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        return {code, readWholeFile(folder / "out"), readWholeFile(folder / "err")};
    }

 private:
    pid_t process_ = -1;
    int socket_ = -1;
};

#ifndef __SANITIZE_THREAD__
// The framework owns it.
const auto* const splitter = static_cast<Splitter*>(testing::AddGlobalTestEnvironment(new Splitter));
#endif

}  // namespace

ProcessResult runLoaded(const std::vector<std::string>& arguments) {
#ifdef __SANITIZE_THREAD__
    // Its own threads are there before any of ours.
    std::vector<std::string> words{programPath("eyrie-cli")};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return runProcess(words);
#else
    return splitter->run(arguments);
#endif
}

}  // namespace eyrie::test
