#include "deploy/film.h"

#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

namespace shearwater::deploy {

namespace fs = std::filesystem;

namespace {

constexpr int not_there = 127;  // as shells have it

// The exit status of a program found on the path; nothing when it was killed.
base::Result<int> run(std::vector<std::string> words) {
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        execvp(argv[0], argv.data());
        _exit(not_there);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) {
        return base::error(base::Code::io, "start " + words[0], std::strerror(errno));
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

bool is_film(const std::string& path) {
    const std::string kind = fs::path(path).extension().string();
    return kind == ".mp4" || kind == ".mkv" || kind == ".mov";
}

base::Status encode_film(const std::string& frames, int fps, const std::string& film) {
    const fs::path path(film);
    const fs::path part =
        path.parent_path() / fmt::format(".{}.part{}", path.stem().string(), path.extension().string());
    const std::string operation = "write " + film;
    const auto status = run({"ffmpeg",    "-nostdin",   "-hide_banner", "-loglevel",
                             "error",     "-y",         "-framerate",   std::to_string(fps),
                             "-i",        frames,       "-vf",          "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                             "-c:v",      "libx264",    "-preset",      "medium",
                             "-crf",      "17",         "-pix_fmt",     "yuv420p",
                             "-movflags", "+faststart", part.string()});
    std::error_code failed;
    if (!status) {
        return status.error();
    }
    if (*status != 0) {
        fs::remove(part, failed);
        return *status == not_there ? base::error(base::Code::not_found, operation,
                                                  "ffmpeg is not installed; the frames stay where they are")
                                    : base::error(base::Code::io, operation,
                                                  fmt::format("ffmpeg ended with status {}", *status));
    }
    fs::rename(part, path, failed);
    if (failed) {
        return base::error(base::Code::io, operation, failed.message());
    }
    return {};
}

}  // namespace shearwater::deploy
