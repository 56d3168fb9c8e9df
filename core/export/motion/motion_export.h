// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/motion/motion_writer.h"
#include "core/log/output_file.h"
#include "core/words/fact.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Motion to files that other programs read: the one list of formats, which help and dialogs walk, and the
/// one function that writes them.
namespace posewire::exporting {

struct MotionFormat {
    const char* title;         ///< "CSV", for menus
    const char* kind;          ///< "Comma-separated values", for file dialogs
    const char* suffix;        ///< without the dot, in small letters; names the format in commands
    const char* holds;         ///< what is in it, half a sentence
    words::Kind gaps;          ///< what stands for a sample that did not come whole
    bool holdsSeveral = false; ///< characters in one file; else each has a file of its own
    bool takesMarkers = false; ///< instead of segments, where they were sent
    bool hasTimes = false;     ///< of samples; else a pause at a restart is left out
    std::unique_ptr<MotionWriter> (*make)(const MotionTask& task);
};

[[nodiscard]] std::span<const MotionFormat> motionFormats();

/// By the suffix, in whatever case; null if there is none.
[[nodiscard]] const MotionFormat* findMotionFormat(std::string_view suffix);
/// The one that a file's name asks for; null if it ends with no suffix of the list.
[[nodiscard]] const MotionFormat* motionFormatOf(std::string_view fileName);

struct MotionRequest {
    const feed::PoseSource& source;
    const MotionFormat& format;
    std::string path;
    log::OutputRules rules{};
    std::string application{}; ///< name and version of who writes it
    MakeBodyMesh makeBody{};   ///< for formats with figures; empty: they have joints alone
};

/// Where each character of the source goes: all to the path, or, where a file holds one and there are
/// several, each to a file beside it that has the character's name behind the path's: "take-Factory.bvh".
[[nodiscard]] std::vector<std::string> motionPaths(const MotionRequest& request);

struct ExportedMotion {
    std::size_t character = 0; ///< its place in the source
    std::string path;
    feed::PoseContent content = feed::PoseContent::Segments;
    std::uint64_t frames = 0; ///< with gaps
    std::uint64_t gaps = 0;
    std::uint64_t restarts = 0;
};

/// A line: "Mira: 1200 samples to take.csv; 3 are missing: a row without values".
[[nodiscard]] words::Fact describe(const ExportedMotion& exported, const feed::PoseSource& source,
                                   const MotionFormat& format);

/// Writes the motion of a source; each file is there whole or not at all. What was written, those without a
/// sample left out. Fails with FileError::Kind::Cancelled where `progress` says so; nothing is left then.
[[nodiscard]] tl::expected<std::vector<ExportedMotion>, log::FileError>
exportMotion(const MotionRequest& request, const ExportProgress& progress = {});

} // namespace posewire::exporting
