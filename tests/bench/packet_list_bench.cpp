// SPDX-License-Identifier: GPL-3.0-or-later
// Scrolling, selecting and filtering among ten million listed packets, painted without a display. Limits: 33
// ms a frame (30 frames a second), 16 ms to select, 2 s to filter a million in the background. What the
// window's own thread does while a filter runs, and to find the next problem in a filtered list, must not be
// felt.
#include "app/gui/models/packet_choice.h"
#include "app/gui/models/packet_model.h"
#include "app/gui/models/packet_search.h"
#include "app/gui/panels/packet_view.h"
#include "app/gui/theme/theme.h"
#include "core/log/packet_log.h"
#include "core/model/session/accounts.h"
#include "core/model/session/session.h"
#include "core/wire/codec.h"

#include <QApplication>
#include <QScrollBar>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <random>
#include <thread>
#include <vector>

using namespace posewire;

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

void fill(log::PacketLog& log, std::size_t count) {
    wire::Datagram datagram;
    datagram.body = wire::TimeCode{};
    const auto sender = log.senders().intern({"192.168.10.21:52011", log::Transport::Udp, 9763});
    std::vector<std::byte> bytes;
    for (std::size_t i = 0; i < count; ++i) {
        datagram.header.sampleCounter = static_cast<std::uint32_t>(i + i / 1000);
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        if (wire::encodeInto(datagram, bytes)) {
            log.writer().append(bytes,
                                {.stamp = log::Stamp(std::chrono::microseconds(100 * i)), .sender = sender});
        }
    }
    log.writer().publish();
}

/// The median and the worst of what an action and the picture after it take, in ms.
template <class Action>
std::pair<double, double> measure(gui::PacketView& view, QImage& image, int times, const Action& action) {
    std::vector<double> taken;
    for (int i = 0; i < times; ++i) {
        const auto begin = Clock::now();
        action();
        view.render(&image);
        taken.push_back(millisecondsSince(begin));
    }
    std::ranges::sort(taken);
    return {taken[taken.size() / 2], taken.back()};
}

int report(const char* name, std::pair<double, double> taken, double limitMs, bool isChecked) {
    std::printf("%s %.2f %.0f\n", name, taken.first, limitMs);
    std::fprintf(stderr, "  median %.2f ms, worst %.2f ms\n", taken.first, taken.second);
    return isChecked && taken.first > limitMs ? 1 : 0;
}

/// Seconds for a million packets; the window's thread asks for what was found as it would each tick.
int filterAll(model::Session& session, gui::PacketModel& model, bool isChecked) {
    auto begin = Clock::now();
    gui::PacketFilterRun run(session, *filter::Filter::compile("gap > 0 || sample >= 0"));
    model.beginMatches();
    double longestMs = 0;
    gui::PacketFilterRun::Progress progress;
    do {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        progress = run.progress();
        const auto tick = Clock::now();
        model.addMatches(run.take(session));
        model.refresh();
        longestMs = std::max(longestMs, millisecondsSince(tick));
    } while (progress.done < progress.total);
    const double seconds = millisecondsSince(begin) / 1000 / static_cast<double>(progress.total) * 1e6;
    begin = Clock::now();
    const bool hasProblem =
        nearestListed(session, model, gui::Landmark::Problem, gui::Direction::Backward).has_value();
    const double problemMs = millisecondsSince(begin);
    begin = Clock::now();
    const std::size_t matches = model.matches().size();
    std::fprintf(stderr, "  %zu rows; problem %s in %.3f ms, rows copied for a search in %.2f ms\n", matches,
                 hasProblem ? "found" : "missing", problemMs, millisecondsSince(begin));
    std::printf("filter-million-s %.2f 2\nfilter-tick-ms %.2f 33\n", seconds, longestMs);
    return isChecked && (seconds > 2 || longestMs > 33) ? 1 : 0;
}

/// To look through all digests for a packet of the stream that is not there.
void lookForStream(const model::Session& session) {
    const auto begin = Clock::now();
    std::size_t found = 0;
    for (std::uint64_t number = session.begin(); number < session.end(); ++number) {
        found += session.accounts().digests().find(number)->type == 77 ? 1 : 0;
    }
    std::fprintf(stderr, "  all digests (%zu found) in %.2f ms\n", found, millisecondsSince(begin));
}

} // namespace

int main(int argumentCount, char** arguments) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication application(argumentCount, arguments);
    gui::applyTheme(application, gui::ThemeChoice::Dark);
    const auto has = [&](const char* option) {
        return std::any_of(arguments, arguments + argumentCount,
                           [&](const char* given) { return std::strcmp(given, option) == 0; });
    };
    const std::size_t packets = has("--brief") ? 100'000 : 10'000'000;
    log::PacketLog log({.memoryCap = std::size_t{2} << 30, .chunkSize = std::size_t{8} << 20});
    fill(log, packets);
    model::Session session(log);
    while (session.follow(log::Stamp())) {
    }
    gui::PacketModel model(session);
    gui::PacketView view("Packets");
    view.setModel(&model);
    view.resize(1000, 700);
    view.show();
    const auto begin = Clock::now();
    model.refresh();
    std::fprintf(stderr, "%d rows listed in %.2f ms\n", model.rowCount(), millisecondsSince(begin));
    QImage image(view.size(), QImage::Format_RGB32);
    std::mt19937 random(1);
    constexpr int kTimes = 100;
    int value = 0;
    const auto scroll = measure(view, image, kTimes, [&] { view.verticalScrollBar()->setValue(value += 3); });
    const auto jump = measure(view, image, kTimes, [&] {
        view.verticalScrollBar()->setValue(static_cast<int>(random() % packets));
    });
    const auto select =
        measure(view, image, kTimes, [&] { view.showRow(static_cast<int>(random() % packets)); });
    const bool isChecked = has("--check");
    lookForStream(session);
    return report("scroll-ms", scroll, 33, isChecked) + report("jump-ms", jump, 33, isChecked) +
           report("select-ms", select, 16, isChecked) + filterAll(session, model, isChecked);
}
