// SPDX-License-Identifier: MIT
#include "core/export/comparison/comparison_csv.h"

#include "core/export/motion/motion_writer.h"
#include "core/export/sheets.h"

#include <optional>

namespace posewire::exporting {
namespace {

std::string decimalCell(double value, int decimals) {
    std::string text;
    appendFixed(value, decimals, text);
    return text;
}

std::vector<std::string> titles(std::span<const SegmentFigures> segments) {
    std::vector<std::string> cells{"time", "sample", "timeCode", "otherSample", "otherTimeCode"};
    for (const SegmentFigures& one : segments) {
        const std::string name(model::segmentName(model::kAllSegments, one.slot));
        cells.push_back(name + " mm");
        cells.push_back(name + " degrees");
    }
    return cells;
}

std::vector<std::string> csvRow(const ComparedPair& pair, std::span<const SegmentFigures> segments,
                                log::Stamp begin) {
    std::vector<std::string> cells{decimalCell(log::secondsOf(pair.first->stamp - begin), 4),
                                   std::to_string(pair.first->sample), std::to_string(pair.first->timeCode)};
    cells.push_back(pair.second != nullptr ? std::to_string(pair.second->sample) : std::string());
    cells.push_back(pair.second != nullptr ? std::to_string(pair.second->timeCode) : std::string());
    for (const SegmentFigures& one : segments) {
        const model::SegmentDifference* difference =
            pair.difference != nullptr ? pair.difference->find(one.slot) : nullptr;
        cells.push_back(difference != nullptr ? decimalCell(difference->millimetres, 2) : std::string());
        cells.push_back(difference != nullptr ? decimalCell(difference->degrees, 3) : std::string());
    }
    return cells;
}

} // namespace

tl::expected<void, log::FileError> writeComparisonCsv(const ComparisonTask& task,
                                                      std::span<const SegmentFigures> segments,
                                                      const std::string& path, const log::OutputRules& rules,
                                                      const ExportProgress& progress) {
    auto sink = log::createWholeFile(path, rules);
    if (!sink) {
        return tl::unexpected(sink.error());
    }
    MotionOutput out(std::move(*sink));
    out.write(csvLine(titles(segments)));
    std::optional<log::Stamp> begin;
    const auto walked = walkPairs(
        task,
        [&](const ComparedPair& pair) {
            begin = begin.value_or(pair.first->stamp);
            out.write(csvLine(csvRow(pair, segments, *begin)));
        },
        [&](double share) { return !out.hasFailed() && (!progress || progress(share)); });
    if (!walked && !out.hasFailed()) {
        return tl::unexpected(walked.error());
    }
    if (walked && *walked != 0) {
        out.fail(path + ": the log dropped part of the range while it was written; choose a later beginning");
    }
    return out.finish();
}

} // namespace posewire::exporting
