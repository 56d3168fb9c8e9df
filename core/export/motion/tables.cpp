// SPDX-License-Identifier: MIT
#include "core/export/motion/motion_writer.h"

#include "core/export/json_value.h"
#include "core/export/motion/pose_lines.h"
#include "core/export/motion/skeleton.h"
#include "core/export/sheets.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::exporting {
namespace {

using model::SegmentLayout;
using model::SegmentPose;

/// In nanoseconds; empty if the file does not say.
std::string receiptText(const MotionTask& task, const MotionFrame& frame) {
    const auto receipt = task.receiptOf(frame);
    return receipt ? std::to_string(log::nanosecondsOf(*receipt)) : std::string();
}

/// Empty if type 25 did not come.
std::string_view timeOfDayText(const MotionFrame& frame) {
    return frame.timeOfDay ? frame.timeOfDay->view() : std::string_view();
}

SegmentLayout widest(const MotionTask& task) {
    SegmentLayout all{0, 0, 0};
    for (const std::size_t place : task.characters) {
        const SegmentLayout& layout = task.surveyAt(place).layout;
        all = {std::max(all.body, layout.body), std::max(all.props, layout.props),
               std::max(all.fingers, layout.fingers)};
    }
    return all;
}

class CsvWriter final : public MotionWriter {
public:
    explicit CsvWriter(const MotionTask& task) : m_task(task), m_layout(widest(task)) {
        for (const feed::PoseCharacter& character : task.source.characters) {
            std::string cell = csvLine(std::vector{character.name.csv()});
            cell.resize(cell.size() - 2); // the end of the line
            m_begins.push_back(cell + ',' + std::to_string(character.key.character) + ',');
        }
    }

    void begin(MotionOutput& out) override {
        std::vector<std::string> cells{"character",      "id",       "run",
                                       "sample",         "time (s)", "received (ns since 1970 UTC)",
                                       "time code (ms)", "type"};
        for (int position = 0; position < m_layout.count(); ++position) {
            const std::string name(model::segmentName(m_layout, position));
            for (const char* part : {" x (m)", " y (m)", " z (m)", " qw", " qx", " qy", " qz"}) {
                cells.push_back(name + part);
            }
        }
        for (int position = 0; position < m_layout.count(); ++position) {
            cells.push_back(std::string(model::segmentName(m_layout, position)) + " from");
        }
        if (m_hasTimeOfDay) {
            cells.emplace_back("time of day");
        }
        out.write(csvLine(cells));
    }

    void add(const MotionFrame& frame, MotionOutput& out) override {
        m_line = m_begins[frame.character];
        m_line += std::to_string(frame.run) + ',' + std::to_string(frame.sample) + ',';
        appendFixed(frame.seconds, 6, m_line);
        m_line += ',';
        if (frame.isGap()) {
            m_line.append(
                (m_hasTimeOfDay ? 3 : 2) + (kCells + 1) * static_cast<std::size_t>(m_layout.count()), ',');
        } else {
            m_line += receiptText(m_task, frame) + ',' + std::to_string(frame.pose->timeCode) + ',';
            m_line += wire::typeDigits(frame.pose->type);
            for (int position = 0; position < m_layout.count(); ++position) {
                addSegment(*frame.pose, position);
            }
            for (int position = 0; position < m_layout.count(); ++position) {
                const auto from = static_cast<std::size_t>(provenanceAt(*frame.pose, m_layout, position));
                m_line.append(",").append(kProvenanceNames[from]);
            }
            if (m_hasTimeOfDay) {
                m_line.append(",").append(timeOfDayText(frame));
            }
        }
        m_line += "\r\n";
        out.write(m_line);
    }

private:
    static constexpr std::size_t kCells = 7; ///< of a segment

    void addSegment(const model::CharacterPose& pose, int column) {
        const SegmentPose* segment = poseAt(pose, m_layout, column);
        if (segment == nullptr) {
            m_line.append(kCells, ',');
            return;
        }
        const Eigen::Quaterniond& turn = segment->orientation;
        for (const double value : {segment->position.x(), segment->position.y(), segment->position.z(),
                                   turn.w(), turn.x(), turn.y(), turn.z()}) {
            m_line += ',';
            appendNumber(value, m_line);
        }
    }

    const MotionTask& m_task;
    SegmentLayout m_layout;
    bool m_hasTimeOfDay = m_task.hasTimeOfDay();
    std::vector<std::string> m_begins; ///< of the lines of each character
    std::string m_line;
};

class JsonLinesWriter final : public MotionWriter {
public:
    explicit JsonLinesWriter(const MotionTask& task) : m_task(task) {
        for (const feed::PoseCharacter& character : task.source.characters) {
            // The bytes that were sent; not where they are so many that each sample would be drowned in them.
            const bool isShort = character.name.exact().size() <= model::ForeignText::kMostBytes;
            const std::string name(isShort ? character.name.exact() : character.name.shown());
            m_begins.push_back("{\"character\":" + jsonText(name) +
                               ",\"id\":" + std::to_string(character.key.character) + ",\"run\":");
        }
    }

    void add(const MotionFrame& frame, MotionOutput& out) override {
        m_line = m_begins[frame.character];
        m_line += std::to_string(frame.run) + ",\"sample\":" + std::to_string(frame.sample) + ",\"time\":";
        appendFixed(frame.seconds, 6, m_line);
        if (frame.isGap()) {
            m_line += ",\"segments\":null}\n";
        } else {
            appendPose(*frame.pose, receiptText(m_task, frame), timeOfDayText(frame), m_line);
            m_line += '\n';
        }
        out.write(m_line);
    }

private:
    const MotionTask& m_task;
    std::vector<std::string> m_begins;
    std::string m_line;
};

} // namespace

std::unique_ptr<MotionWriter> makeMotionCsv(const MotionTask& task) {
    return std::make_unique<CsvWriter>(task);
}

std::unique_ptr<MotionWriter> makeMotionJsonLines(const MotionTask& task) {
    return std::make_unique<JsonLinesWriter>(task);
}

} // namespace posewire::exporting
