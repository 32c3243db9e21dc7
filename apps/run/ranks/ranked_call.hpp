#pragma once

#include "apps/run/options.hpp"
#include "apps/scene/scene.hpp"
#include "dem/ranks/ranks.hpp"

#include <optional>
#include <string>
#include <vector>

namespace listric {

/// One of the things that all processes of a run must have been called with.
struct CallPart {
    std::string of;    ///< difference, as "was called with another scene"
    std::string name;  ///< "detachment.friction"
    std::string value; ///< as text
};

/// All of them: program, scene, target and output. The scene is what files say by now, whatever
/// their names. What may differ is not among them: threads, the level of the cycle, what is told.
std::vector<CallPart> call_of(const Scene& scene, const RunOptions& options);

/// The first in which a process was called otherwise than the root, in words that follow its name:
/// "was called with another scene: detachment.friction 0.1 there, 0.5 here".
std::optional<std::string> first_difference(const std::vector<CallPart>& root,
                                            const std::vector<CallPart>& there);

// As a letter between processes, which may be of other programs: in words alone.
dem::Bytes packed(const std::vector<CallPart>& call);
std::vector<CallPart> unpacked_call(const dem::Bytes& letter);

} // namespace listric
