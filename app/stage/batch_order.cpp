// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stage/batch_order.h"

#include "app/stage/batch.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <string_view>
#include <utility>

namespace posewire::stage {

std::optional<std::uint64_t> numberOf(std::string_view text) {
    std::uint64_t number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    return read.ec == std::errc() && read.ptr == text.data() + text.size() ? std::optional(number)
                                                                           : std::nullopt;
}

bool isName(const std::string& name) {
    constexpr std::size_t kMost = 64;
    return !name.empty() && name.size() <= kMost && std::ranges::all_of(name, [](char one) {
        return (one >= 'a' && one <= 'z') || (one >= 'A' && one <= 'Z') || (one >= '0' && one <= '9') ||
               one == '-' || one == '_';
    });
}

std::uint64_t signOf(const log::FileRecord& record) {
    const std::string_view bytes(reinterpret_cast<const char*>(record.bytes.data()), record.bytes.size());
    const auto time = static_cast<std::uint64_t>(log::nanosecondsOf(record.time.value_or(log::WallTime())));
    return std::hash<std::string_view>()(bytes) ^ (time * 0x9e3779b97f4a7c15U);
}

std::string probeOf(const Message& message) {
    const std::string subject = subjectOf(message);
    const std::size_t end = subject.rfind('.');
    const std::size_t begin = end == std::string::npos || end == 0 ? end : subject.rfind('.', end - 1);
    const std::string name =
        begin == std::string::npos ? std::string() : subject.substr(begin + 1, end - begin - 1);
    return isName(name) ? name : std::string();
}

BatchOrder::Taken BatchOrder::take(const Message& batch, const log::FileVisitor& visit) {
    Taken taken;
    taken.probe = probeOf(batch);
    if (taken.probe.empty()) {
        return taken;
    }
    Course& course = m_courses[taken.probe];
    const bool isFirst = course.run != headerOf(batch, kRunHeader);
    if (!isNews(course, batch, taken)) {
        return taken;
    }
    // A server may have stored the last batch of a probe that died before it was acknowledged: the next run
    // then begins with the same packets, in as many batches as it likes.
    if (isFirst) {
        course.repeating = std::move(course.signs);
    }
    course.signs.clear();
    std::uint64_t missing = taken.lostOnWay;
    const auto read = readBatch(bytesOf(batch), [&](const log::FileRecord& record) {
        course.signs.push_back(signOf(record));
        if (std::ranges::find(course.repeating, course.signs.back()) != course.repeating.end()) {
            return;
        }
        course.repeating.clear();
        log::FileRecord handed = record;
        handed.sender = record.sender.value_or(log::SenderInfo{});
        handed.sender->probe = taken.probe;
        if (const std::uint64_t before = std::exchange(missing, 0); before != 0) {
            log::FileRecord lost = handed;
            lost.bytes = {};
            lost.comments = {};
            lost.flags = {.skipped = true, .isDropRecord = true, .isLostOnWay = true};
            lost.kernelDropsBefore = static_cast<std::uint32_t>(std::min<std::uint64_t>(before, UINT32_MAX));
            visit(lost);
        }
        visit(handed);
        ++taken.packets;
    });
    if (!read) {
        taken.problem = "a batch of it is damaged: " + read.error().text;
    }
    return taken;
}

/// Notes how far the probe has come. Returns false if the batch came before or cannot be read.
bool BatchOrder::isNews(Course& course, const Message& batch, Taken& taken) const {
    const std::string run = headerOf(batch, kRunHeader);
    const auto layout = numberOf(headerOf(batch, kLayoutHeader));
    const auto first = numberOf(headerOf(batch, kFirstHeader));
    const auto count = numberOf(headerOf(batch, kCountHeader));
    if (layout != kLayout || !first || !count || run.empty()) {
        taken.problem = "it publishes in a layout that this version does not know; have the same version of "
                        "Posewire on both computers";
        return false;
    }
    if (course.runsBefore.contains(run)) {
        taken.problem = "two probes of this name publish at the same time; give one of them another name";
    }
    if (run != course.run) {
        constexpr std::size_t kMostRuns = 1000;
        if (!course.run.empty() && course.runsBefore.size() < kMostRuns) {
            course.runsBefore.insert(course.run);
        }
        course.next = *first;
        course.run = run;
    }
    if (*first < course.next) {
        return false;
    }
    taken.lostOnWay = *first - std::exchange(course.next, *first + *count);
    return true;
}

} // namespace posewire::stage
