// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/motion/body_mesh.h"
#include "core/export/motion/motion_reader.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::exporting {

/// A file that is written in large pieces. After a failure what is written goes nowhere.
class MotionOutput {
public:
    explicit MotionOutput(std::unique_ptr<log::ByteSink> sink) : m_sink(std::move(sink)) {}

    void write(std::string_view bytes);
    /// Last of all: without it the file does not come to be. Says what failed first.
    [[nodiscard]] tl::expected<void, log::FileError> finish();
    /// The writer cannot go on: what is wrong and what to do.
    void fail(std::string text);
    [[nodiscard]] bool hasFailed() const { return !m_result; }

private:
    void flush();

    std::unique_ptr<log::ByteSink> m_sink;
    std::string m_buffer;
    tl::expected<void, log::FileError> m_result;
};

/// All of it outlives the writer.
struct MotionTask {
    const feed::PoseSource& source;
    const MotionSurvey& survey;
    std::vector<std::size_t> characters; ///< of this file, places in the source: each has frames
    std::string application;             ///< name and version of who writes it
    MakeBodyMesh makeBody;               ///< empty: figures have no body, only joints

    [[nodiscard]] const feed::PoseCharacter& characterAt(std::size_t place) const {
        return source.characters[place];
    }
    [[nodiscard]] const CharacterSurvey& surveyAt(std::size_t place) const {
        return survey.characters[place];
    }
};

/// Writes one file of a format.
class MotionWriter {
public:
    MotionWriter() = default;
    virtual ~MotionWriter() = default;
    MotionWriter(const MotionWriter&) = delete;
    MotionWriter& operator=(const MotionWriter&) = delete;

    virtual void begin(MotionOutput&) {}
    virtual void add(const MotionFrame& frame, MotionOutput& out) = 0;
    virtual void finish(MotionOutput&) {}
};

/// The fewest digits that read back to the same 32 bits.
void appendNumber(double value, std::string& text);
/// With so many decimals.
void appendFixed(double value, int decimals, std::string& text);

} // namespace posewire::exporting
