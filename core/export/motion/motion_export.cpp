// SPDX-License-Identifier: MIT
#include "core/export/motion/motion_export.h"

#include "core/export/formats.h"
#include "core/log/file_names.h"
#include "core/wire/text.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <set>
#include <system_error>
#include <utility>

namespace posewire::exporting {
namespace {

using log::FileError;

/// The characters of a source that are read in one way.
struct Share {
    feed::PoseContent content = feed::PoseContent::Segments;
    feed::PoseSource source;
    std::vector<std::size_t> places; ///< of its characters in the whole source
    MotionSurvey survey;
};

struct OpenFile {
    MotionTask task;
    MotionOutput out;
    std::unique_ptr<MotionWriter> writer;
    std::uint64_t samples = 0; ///< that are still to come
};

Share shareOf(const feed::PoseSource& source, feed::PoseContent content,
              const std::vector<std::size_t>& places) {
    Share share{content, {source.log, source.firstPacket, source.endPacket, {}}, places, {}};
    for (const std::size_t place : places) {
        share.source.characters.push_back(source.characters[place]);
    }
    return share;
}

/// Part `index` of `count` parts that take about as long.
ExportProgress partOf(const ExportProgress& progress, int index, int count) {
    return [&progress, index, count](double share) { return !progress || progress((index + share) / count); };
}

/// Markers of those who sent them, where they are wanted; poses of the others.
tl::expected<std::vector<Share>, FileError> surveyed(const MotionRequest& request,
                                                     const ExportProgress& progress) {
    std::vector<std::size_t> left(request.source.characters.size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    std::vector<feed::PoseContent> contents{feed::PoseContent::Segments};
    if (request.format.takesMarkers) {
        contents.insert(contents.begin(), feed::PoseContent::Markers);
    }
    std::vector<Share> shares;
    for (const feed::PoseContent content : contents) {
        Share share = shareOf(request.source, content, left);
        const auto part = static_cast<int>(shares.size());
        auto survey =
            surveyMotion(share.source, content, partOf(progress, part, static_cast<int>(contents.size())));
        if (!survey) {
            return tl::unexpected(survey.error());
        }
        share.survey = std::move(*survey);
        std::erase_if(left, [&](std::size_t place) {
            const auto at = std::ranges::find(share.places, place) - share.places.begin();
            return share.survey.characters[static_cast<std::size_t>(at)].frames != 0;
        });
        shares.push_back(std::move(share));
    }
    return shares;
}

/// Opens the files of a share; which of them a character goes to, by its place in the share: null if it
/// has no sample.
tl::expected<std::vector<OpenFile*>, FileError> opened(const MotionRequest& request, const Share& share,
                                                       const std::vector<std::string>& paths,
                                                       std::vector<std::unique_ptr<OpenFile>>& files) {
    std::vector<OpenFile*> fileOf(share.places.size());
    OpenFile* common = nullptr;
    for (std::size_t i = 0; i < share.places.size(); ++i) {
        if (share.survey.characters[i].frames == 0) {
            continue;
        }
        if (common == nullptr || !request.format.holdsSeveral) {
            auto sink = log::createWholeFile(paths[share.places[i]], request.rules);
            if (!sink) {
                return tl::unexpected(sink.error());
            }
            files.push_back(std::make_unique<OpenFile>(
                OpenFile{{share.source, share.survey, {}, request.application, request.makeBody},
                         MotionOutput(std::move(*sink)),
                         nullptr}));
            common = files.back().get();
        }
        common->task.characters.push_back(i);
        common->samples += share.survey.characters[i].frames - share.survey.characters[i].gaps;
        fileOf[i] = common;
    }
    return fileOf;
}

tl::expected<void, FileError> write(const MotionRequest& request, const Share& share,
                                    const std::vector<std::string>& paths, const ExportProgress& progress,
                                    std::vector<std::unique_ptr<OpenFile>>& files) {
    const std::size_t before = files.size();
    const auto fileOf = opened(request, share, paths, files);
    if (!fileOf) {
        return tl::unexpected(fileOf.error());
    }
    const std::span ours = std::span(files).subspan(before);
    if (ours.empty()) {
        return {};
    }
    for (const auto& file : ours) {
        file->writer = request.format.make(file->task);
        file->writer->begin(file->out);
    }
    const auto read = readMotion(
        share.source, share.content, share.survey,
        [&](const MotionFrame& frame) {
            if (OpenFile* file = (*fileOf)[frame.character]) {
                file->writer->add(frame, file->out);
                file->samples -= frame.isGap() ? 0 : 1;
            }
        },
        [&](double done) {
            const bool isLost =
                std::ranges::any_of(ours, [](const auto& file) { return file->out.hasFailed(); });
            return !isLost && progress(done);
        });
    for (const auto& file : ours) {
        if (read && file->samples != 0) {
            file->out.fail(request.path +
                           ": the log dropped part of the range while it was written; choose a later "
                           "beginning");
        } else if (read) {
            file->writer->finish(file->out);
        }
        if (file->out.hasFailed()) {
            return file->out.finish();
        }
    }
    return read;
}

void tell(const Share& share, const std::vector<std::string>& paths, std::vector<ExportedMotion>& exported) {
    for (std::size_t i = 0; i < share.places.size(); ++i) {
        const CharacterSurvey& survey = share.survey.characters[i];
        if (survey.frames != 0) {
            const std::size_t place = share.places[i];
            exported.push_back(
                {place, paths[place], share.content, survey.frames, survey.gaps, survey.restarts});
        }
    }
}

tl::expected<void, FileError> checkAll(const MotionRequest& request, const std::vector<std::string>& paths) {
    std::error_code error;
    const auto kind = std::filesystem::status(log::pathOf(request.path), error).type();
    const bool isOrdinary =
        request.path != log::kStandardOutput && // a file behind it has another name
        (kind == std::filesystem::file_type::regular || kind == std::filesystem::file_type::not_found);
    if (!isOrdinary && !paths.empty() && paths.front() != request.path) {
        return tl::unexpected(
            FileError{request.path + ": is a folder or a device, and " + request.format.suffix +
                      " has a file for each character; name a file, or choose one character"});
    }
    for (const std::string& path : paths) {
        if (const auto checked = log::checkOutput(path, request.rules); !checked) {
            return tl::unexpected(checked.error());
        }
    }
    return {};
}

constexpr MotionFormat kFormats[] = {
    {.title = "CSV",
     .kind = "Comma-separated values",
     .suffix = "csv",
     .holds = "a row for each sample, with position and quaternion of each segment",
     .gaps = words::Kind::GapsWithoutValues,
     .holdsSeveral = true,
     .hasTimes = true,
     .make = makeMotionCsv},
    {.title = "JSON Lines",
     .kind = "JSON Lines",
     .suffix = "jsonl",
     .holds = "an object for each sample, one on a line",
     .gaps = words::Kind::GapsNull,
     .holdsSeveral = true,
     .hasTimes = true,
     .make = makeMotionJsonLines},
    {.title = "NumPy",
     .kind = "Arrays of NumPy",
     .suffix = "npz",
     .holds = "arrays of times, positions, orientations and their provenance, for numpy.load",
     .gaps = words::Kind::GapsWithoutValues,
     .hasTimes = true,
     .make = makeNumpy},
    {.title = "BVH",
     .kind = "Biovision hierarchy",
     .suffix = "bvh",
     .holds = "body and fingers as a skeleton of constant bones, in centimetres",
     .gaps = words::Kind::GapsRepeat,
     .make = makeBvh},
    {.title = "glTF",
     .kind = "Binary glTF 2.0",
     .suffix = "glb",
     .holds = "animated figures, with props",
     .gaps = words::Kind::GapsBridged,
     .holdsSeveral = true,
     .hasTimes = true,
     .make = makeGlb},
    {.title = "C3D",
     .kind = "C3D",
     .suffix = "c3d",
     .holds = "markers where they were sent, else segment origins, in millimetres",
     .gaps = words::Kind::GapsUnmeasured,
     .takesMarkers = true,
     .make = makeC3d},
    {.title = "MVNX",
     .kind = "MVN XML",
     .suffix = "mvnx",
     .holds = "body, null pose and joint angles as XML of version 4",
     .gaps = words::Kind::GapsLeftOut,
     .hasTimes = true,
     .make = makeMvnx},
};

} // namespace

words::Fact describe(const ExportedMotion& exported, const feed::PoseSource& source,
                     const MotionFormat& format) {
    using K = words::Kind;
    const auto counted = [](K kind, std::uint64_t count) {
        return words::Fact{kind, {{"n", words::Number{static_cast<double>(count)}}}};
    };
    const bool isMarkers = exported.content == feed::PoseContent::Markers;
    words::Fact fact{
        K::Exported,
        {{"name", source.characters[exported.character].name.shown()},
         {"samples", counted(isMarkers ? K::MarkerSamples : K::Samples, exported.frames - exported.gaps)},
         {"path", exported.path}}};
    if (exported.gaps != 0) {
        words::Fact missing = counted(K::SamplesMissing, exported.gaps);
        set(missing, "gaps", words::Fact(format.gaps));
        set(fact, "missing", std::move(missing));
    }
    if (exported.restarts != 0) {
        words::Fact restarts = counted(K::RestartedTimes, exported.restarts);
        set(restarts, "pause", words::Fact(format.hasTimes ? K::Nothing : K::PauseLeftOut));
        set(fact, "restarts", std::move(restarts));
    }
    return fact;
}

std::vector<std::string> motionPaths(const MotionRequest& request) {
    const std::vector<feed::PoseCharacter>& characters = request.source.characters;
    std::vector<std::string> paths(characters.size(), request.path);
    if (request.format.holdsSeveral || characters.size() < 2) {
        return paths;
    }
    const std::filesystem::path path = log::pathOf(request.path);
    std::set<std::string> taken; // in small letters: some file systems see no difference
    for (std::size_t i = 0; i < characters.size(); ++i) {
        const std::string id = "Character " + std::to_string(characters[i].key.character);
        const std::string stem = log::nameOf(path.stem()) + '-' + characters[i].name.fileName(id);
        std::string name = stem;
        for (int next = 2; !taken.insert(wire::lowered(name)).second; ++next) {
            name = stem + '-' + std::to_string(next);
        }
        paths[i] = log::nameOf(path.parent_path() / log::pathOf(name + log::nameOf(path.extension())));
    }
    return paths;
}

tl::expected<std::vector<ExportedMotion>, FileError> exportMotion(const MotionRequest& request,
                                                                  const ExportProgress& progress) {
    const std::vector<std::string> paths = motionPaths(request);
    if (const auto checked = checkAll(request, paths); !checked) {
        return tl::unexpected(checked.error());
    }
    const auto shares = surveyed(request, partOf(progress, 0, 2));
    if (!shares) {
        return tl::unexpected(shares.error());
    }
    std::vector<std::unique_ptr<OpenFile>> files;
    std::vector<ExportedMotion> exported;
    const ExportProgress writing = partOf(progress, 1, 2);
    const int count = static_cast<int>(shares->size());
    for (int i = 0; i < count; ++i) {
        const Share& share = (*shares)[static_cast<std::size_t>(i)];
        if (const auto written = write(request, share, paths, partOf(writing, i, count), files); !written) {
            return tl::unexpected(written.error());
        }
        tell(share, paths, exported);
    }
    for (const auto& file : files) { // only now, so that nothing is left where another one fails
        if (const auto finished = file->out.finish(); !finished) {
            return tl::unexpected(finished.error());
        }
    }
    return exported;
}

std::span<const MotionFormat> motionFormats() {
    return kFormats;
}

const MotionFormat* findMotionFormat(std::string_view suffix) {
    const auto found = std::ranges::find(kFormats, wire::lowered(suffix),
                                         [](const MotionFormat& format) { return format.suffix; });
    return found == std::end(kFormats) ? nullptr : found;
}

const MotionFormat* motionFormatOf(std::string_view fileName) {
    const auto found = std::ranges::find_if(
        kFormats, [&](const MotionFormat& format) { return hasSuffix(fileName, format.suffix); });
    return found == std::end(kFormats) ? nullptr : found;
}

} // namespace posewire::exporting
