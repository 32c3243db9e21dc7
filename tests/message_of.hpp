#pragma once

#include "apps/support/error.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>

namespace listric::support {

/// What the error of a call says; `accepted` where it throws none.
template <class Error, class Call>
std::string message_of(Call&& call, const char* accepted = "accepted") {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return accepted;
}

/// One line of a SceneError, with names of files from `folder` on; else "no error".
template <class Call>
std::string scene_message_of(Call&& call, const std::filesystem::path& folder = {}) {
    std::string message = message_of<SceneError>(call, "no error");
    EXPECT_THAT(message, testing::Not(testing::HasSubstr("\n")));
    if (folder.empty())
        return message;
    const std::string prefix = folder.string() + "/";
    for (auto at = message.find(prefix); at != message.npos; at = message.find(prefix))
        message.erase(at, prefix.size());
    return message;
}

} // namespace listric::support
