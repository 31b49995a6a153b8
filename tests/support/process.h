#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace eyrie::test {

/// What a program that has ended said.
struct ProcessResult {
    int exit_code = -1;  ///< 128 + signal when it was killed
    std::string output;
    std::string errors;
};

/// A child process whose output goes to files.
class Process {
 public:
    explicit Process(const std::vector<std::string>& command) {
        child_ = fork();
        if (child_ < 0) throw std::runtime_error("cannot fork");
        if (child_ == 0) {
            redirect(folder_ / "out", STDOUT_FILENO);
            redirect(folder_ / "err", STDERR_FILENO);
            std::vector<char*> arguments;
            for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
            arguments.push_back(nullptr);
            execv(arguments[0], arguments.data());
            _exit(127);
        }
    }
    pid_t pid() const { return child_; }
    ProcessResult wait() {
        int status = 0;
        waitpid(child_, &status, 0);
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        return {code, contents(folder_ / "out"), contents(folder_ / "err")};
    }

 private:
    static void redirect(const std::filesystem::path& path, int descriptor) {
        const int file = open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
        dup2(file, descriptor);
        close(file);
    }
    static std::string contents(const std::filesystem::path& path) {
        std::ifstream file(path);
        std::ostringstream text;
        text << file.rdbuf();
        return text.str();
    }
    TemporaryFolder folder_;
    pid_t child_ = -1;
};

inline ProcessResult runProcess(const std::vector<std::string>& command) {
    return Process(command).wait();
}

}  // namespace eyrie::test
