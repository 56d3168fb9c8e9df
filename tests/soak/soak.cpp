// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/process_figures.h"
#include "core/log/clock.h"
#include "core/log/disk_history.h"
#include "core/log/recording.h"
#include "core/log/recording_file.h"
#include "core/model/session/accounts.h"
#include "core/model/session/held_up.h"
#include "core/model/session/memory_figures.h"
#include "core/model/session/origin.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "core/words/say.h"
#include "tests/soak/computer.h"
#include "tests/support/manual_clock.h"
#include "tests/support/temporary_folder.h"

#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

// Days of a stage in minutes: log, history on disk, takes, session and verdict as the window has them, on a
// virtual clock. Two computers send two characters each, 12 streams that count samples. Each day has 20 hours
// of 40 minutes with faults and 17 without, at 2 samples a second, and 20 seconds at 60; then four hours of
// silence, in which one computer is switched off: it is started anew with another port, the other never is.
// The first act of a computer is near the end of the sample counter; midnight falls into a quiet act, and in
// the last of each day the time code jumps by an hour. The clock of this computer is set several times a day.
// The session follows ten times a second and judges every five. Each hour is a take in several files, which
// is read back and removed.
//   soak DAYS
// Ends with 1 and the first thing that is not as it should be, with the virtual time.
namespace posewire::soak {
namespace {

constexpr log::Duration kTick = 100ms;
constexpr int kTicksOfVerdict = 50;
/// The window's are 512 MB and 8 GB: these fill within the first hour.
constexpr log::LogLimits kLimits{.memoryCap = std::size_t{32} << 20, .chunkSize = std::size_t{1} << 20};
constexpr std::uint64_t kHistoryBytes = std::uint64_t{32} << 20;
constexpr std::uint64_t kTakeFileBytes = 8'000'000;
/// The writers of files run in real time, so the stage waits for them where they are that far behind.
constexpr std::uint64_t kMostBehind = 10'000;
/// Of memory beside what the session says it keeps, after the first hour: what the heap cannot give back, and
/// the rows of a computer that is started anew, which are listed from then on.
constexpr std::uint64_t kMostGrowth = std::uint64_t{24} << 20;
constexpr std::uint64_t kMostGrowthOfDay = std::uint64_t{2} << 20;
/// Figures of a stream remember what was before its newest samples for as long.
constexpr log::Duration kSettled = 1min;
constexpr log::WallTime kBegin{1'792'800'000s + 22'500s}; // 2026-10-24 06:15 UTC

class Soak {
public:
    explicit Soak(std::filesystem::path folder);

    /// What is not as it should be first; empty if all is.
    [[nodiscard]] const std::string& problem() const { return m_problem; }
    void day(int number);
    [[nodiscard]] std::string figures() const;

private:
    struct Left {
        Computer* from;
        log::Duration at; ///< in the act
        performer::Sending sending;
    };

    void hour(int number, int ofDay);
    void beginPerformance(const Act& act);
    void perform(const Act& act);
    void receive(log::Duration begin);
    void passTo(log::Duration elapsed);
    void tick();
    void waitForDisk() const;
    void setClock(log::Duration by);
    void record();
    void checkTake();
    void checkCounts(const Computer& computer);
    void checkTimes();
    void checkCalm(const Act& act, log::Stamp since);
    void checkBounds();
    void expect(bool isSo, const std::string& what);
    [[nodiscard]] log::Stamp now() const { return m_origin.log().timeline().now(m_clock); }

    const std::filesystem::path m_folder;
    log::ManualClock m_clock{kBegin, log::Moment(1h)};
    model::Origin m_origin;
    log::ClockWatch m_watch{m_origin.log().timeline(), m_clock};
    std::unique_ptr<log::DiskHistory> m_history;
    std::unique_ptr<log::Recording> m_take;
    std::uint64_t m_takeFrom = 0;
    model::HeldUp m_heldUp;
    std::array<Computer, 2> m_computers{Computer{"10.0.0.1", 0}, Computer{"10.0.0.2", Computer::kCharacters}};
    std::optional<performer::Performer> m_performer;
    std::optional<performer::Performer> m_performerLater; ///< in the second half of an act
    std::vector<wire::Datagram> m_frame;
    std::vector<Left> m_left;
    std::vector<performer::Sending> m_sendings;
    log::Duration m_elapsed{};
    log::Duration m_nextTick{};
    std::uint64_t m_ticks = 0;
    std::uint64_t m_sent = 0;
    log::WallTime m_newestWall{};
    log::Duration m_newestAt{};
    std::size_t m_clockSteps = 0;
    int m_summerTime = 0;           ///< hours by which the computers' clocks are ahead
    std::uint64_t m_memoryBase = 0; ///< after an hour; see kMostGrowth
    std::uint64_t m_memoryMost = 0;
    std::uint64_t m_diskMost = 0;
    std::string m_problem;
};

Soak::Soak(std::filesystem::path folder)
    : m_folder(std::move(folder)),
      m_origin(kLimits, std::make_shared<log::Scratch>(m_folder.string(), std::uint64_t{1} << 30)) {
    auto history = log::DiskHistory::start(
        m_origin.log(), {.folder = m_folder.string(), .most = kHistoryBytes, .leaveFree = 0},
        {{}, {}, "soak"});
    expect(history.has_value(), "no history on disk");
    if (history) {
        m_history = std::move(*history);
    }
}

void Soak::expect(bool isSo, const std::string& what) {
    if (isSo || !m_problem.empty()) {
        return;
    }
    const auto minutes = std::chrono::duration_cast<std::chrono::minutes>(m_elapsed + 6h + 15min).count();
    std::array<char, 64> when{};
    std::snprintf(when.data(), when.size(), "day %d, %02d:%02d: ", static_cast<int>(minutes / 1440 + 1),
                  static_cast<int>(minutes / 60 % 24), static_cast<int>(minutes % 60));
    m_problem = when.data() + what;
}

void Soak::waitForDisk() const {
    const std::uint64_t end = m_origin.log().figures().end;
    const auto behind = [&] {
        const std::uint64_t recorded = m_take ? m_takeFrom + m_take->figures().packets : end;
        return end - std::min(recorded, m_history->figures().end);
    };
    while (behind() > kMostBehind && !m_history->failure() && (!m_take || !m_take->failure())) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

void Soak::tick() {
    m_watch.look();
    m_origin.log().writer().publish();
    waitForDisk();
    model::Session& session = m_origin.session();
    session.setHeldUp(m_heldUp.at(now()));
    while (session.follow(now())) {
    }
    if (++m_ticks % kTicksOfVerdict == 0) {
        session.judge();
    }
}

void Soak::passTo(log::Duration elapsed) {
    for (; m_nextTick <= elapsed; m_nextTick += kTick) {
        m_clock.advance(m_nextTick - m_elapsed);
        m_elapsed = m_nextTick;
        tick();
    }
    m_clock.advance(elapsed - m_elapsed);
    m_elapsed = elapsed;
}

void Soak::receive(log::Duration begin) {
    std::ranges::stable_sort(m_left, {}, &Left::at);
    for (const Left& left : m_left) {
        passTo(std::max(m_elapsed, begin + left.at));
        m_watch.look();
        m_newestWall = m_clock.wall();
        m_newestAt = m_elapsed;
        m_origin.log().writer().append(
            left.sending.bytes, {.stamp = m_watch.stampOf(m_newestWall), .sender = left.from->sender()});
        left.from->noteLeft(left.sending);
        ++m_sent;
    }
    m_left.clear();
}

void Soak::setClock(log::Duration by) {
    m_clock.setWall(by);
    m_watch.look();
    ++m_clockSteps;
}

void Soak::beginPerformance(const Act& act) {
    performer::PerformerSettings settings;
    settings.characters = 2 * Computer::kCharacters;
    settings.rateHz = act.rateHz;
    settings.motion = "idle";
    settings.types.assign(Computer::kTypes.begin(), Computer::kTypes.end());
    const auto timeAt = [this](int summerTime) {
        const auto time = m_elapsed + 6h + 15min + std::chrono::hours(24 + summerTime);
        return static_cast<std::uint32_t>(time % 24h / 1ms);
    };
    settings.startTimeOfDayMs = timeAt(m_summerTime);
    m_performer.emplace(settings);
    settings.startTimeOfDayMs = timeAt(m_summerTime + act.summerTime);
    m_performerLater.emplace(settings);
}

void Soak::perform(const Act& act) {
    const log::Stamp since = now();
    const log::Duration begin = m_elapsed;
    beginPerformance(act);
    for (Computer& computer : m_computers) {
        computer.begin(act);
    }
    const auto take = [this](Computer& computer) {
        for (performer::Sending& sending : m_sendings) {
            m_left.push_back({&computer, sending.due, std::move(sending)});
        }
        m_sendings.clear();
    };
    for (std::uint64_t frame = 0; frame < act.frames && m_problem.empty(); ++frame) {
        (frame < act.frames / 2 ? m_performer : m_performerLater)->frameInto(frame, m_frame);
        for (Computer& computer : m_computers) {
            computer.send(frame, m_frame, m_sendings);
            take(computer);
        }
        receive(begin);
        if (frame == act.frames / 2 && act.clockStep != log::Duration()) {
            setClock(act.clockStep);
        }
    }
    for (Computer& computer : m_computers) {
        computer.finish(m_sendings);
        take(computer);
    }
    receive(begin);
    m_summerTime += act.summerTime;
    passTo(std::max(m_elapsed, begin + act.at(act.frames)));
    checkCalm(act, since);
    passTo(m_elapsed + 5s); // what is in doubt is settled
    for (Computer& computer : m_computers) {
        computer.end();
        checkCounts(computer);
    }
    checkTimes();
}

void Soak::record() {
    m_takeFrom = m_origin.log().figures().end;
    auto take = log::Recording::start(m_origin.log(), (m_folder / "take.pcapng").string(), {{}, {}, "soak"},
                                      {}, m_takeFrom, {.fileBytes = kTakeFileBytes});
    expect(take.has_value(), "no take begins");
    if (take) {
        m_take = std::move(*take);
    }
}

void Soak::checkTake() {
    if (!m_take) {
        return;
    }
    expect(m_take->stop().has_value(), "the take did not end well");
    const log::RecordingFigures figures = m_take->figures();
    m_take.reset();
    std::uint64_t packets = 0;
    for (unsigned part = 1; part <= figures.files; ++part) {
        const std::string first = (m_folder / "take.pcapng").string();
        const std::string path = part == 1 ? first : log::partPath(first, part);
        const auto source = log::openFile(path);
        const bool isRead =
            source && log::readFile(**source, [&packets](const log::FileRecord&) { ++packets; });
        expect(isRead, "part " + std::to_string(part) + " of the take cannot be read");
        std::filesystem::remove(path);
    }
    expect(packets == m_origin.log().figures().end - m_takeFrom && figures.missed == 0,
           "the take has " + std::to_string(packets) + " packets");
}

std::string textOf(const performer::SentFigures& one) {
    std::array<char, 200> text{};
    const auto number = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
    std::snprintf(text.data(), text.size(),
                  "%llu datagrams, %llu samples, %llu lost, %llu duplicates, %llu "
                  "reordered, %llu late, %llu incomplete, %llu restarts",
                  number(one.datagrams), number(one.samples), number(one.lost), number(one.duplicates),
                  number(one.reordered), number(one.late), number(one.incomplete), number(one.restarts));
    return text.data();
}

void Soak::checkCounts(const Computer& computer) {
    const model::SessionView& view = m_origin.session();
    const model::Sender* sender = view.roster().find(computer.sender());
    expect(sender != nullptr, "a sender is not listed");
    if (sender == nullptr) {
        return;
    }
    const performer::SenderFigures& total = computer.total();
    expect(sender->malformed == total.malformed && sender->foreign == total.foreign &&
               sender->datagrams == total.datagrams + total.malformed + total.foreign,
           "datagrams of a sender: " + std::to_string(sender->datagrams) + ", malformed " +
               std::to_string(sender->malformed) + ", foreign " + std::to_string(sender->foreign));
    for (auto [key, sent] : computer.sums()) {
        const model::Stream* stream =
            view.roster().find(log::StreamKey{computer.sender(), key.character, key.type});
        performer::SentFigures counted = stream != nullptr
                                             ? performer::figuresOf(stream->accounting.counts(), key.type)
                                             : performer::SentFigures();
        counted.step = counted.firstSample = counted.lastSample = sent.lastSample = 0;
        expect(counted == sent, sender->info.address + " character " + std::to_string(key.character) +
                                    " type " + std::to_string(key.type) + ": sent " + textOf(sent) +
                                    "; counted " + textOf(counted));
    }
}

void Soak::checkTimes() {
    const model::SessionView& view = m_origin.session();
    const auto newest = view.packet(view.end() - 1);
    expect(newest.has_value(), "the newest packet is gone");
    if (newest) {
        expect(std::chrono::abs(view.wallOf(newest->stamp) - m_newestWall) < 1ms, "time of day is off");
        expect(std::chrono::abs(view.now() - newest->stamp - (m_elapsed - m_newestAt)) <= kTick,
               "the age of the newest packet is off");
    }
}

void Soak::checkCalm(const Act& act, log::Stamp since) {
    using model::IncidentKind;
    if (!act.isCalm || act.at(act.frames) <= kSettled) {
        return;
    }
    const model::Verdicts& verdicts = m_origin.session().verdicts();
    expect(verdicts.all().all.state == model::TakeVerdict::State::Good,
           "in calm: " + say(verdicts.all().all.said, words::Form::Sentence));
    int sets = 0;
    for (const model::Incident& one : verdicts.incidents().all()) {
        const bool isExpected = one.kind == IncidentKind::SourceUp || one.kind == IncidentKind::Restart ||
                                one.kind == IncidentKind::Step ||
                                (one.kind == IncidentKind::ClockSet && act.clockStep != log::Duration()) ||
                                (one.kind == IncidentKind::TimeCode && act.summerTime != 0) ||
                                one.detail.kind == words::Kind::ClocksApart; // a damaged one fades slowly
        sets += one.kind == IncidentKind::ClockSet && one.firstStamp >= since ? 1 : 0;
        expect(one.firstStamp < since + kSettled || isExpected,
               "in calm: " + say(one.fact(), words::Form::Sentence) + " (" +
                   std::to_string(log::secondsOf(one.firstStamp - since)) + " s after its beginning)");
    }
    expect(sets == (act.clockStep == log::Duration() ? 0 : 1),
           "this computer's clock was set " + std::to_string(sets) + " times");
}

void Soak::checkBounds() {
    const model::Session& session = m_origin.session();
    const log::DiskHistoryFigures history = m_history->figures();
    expect(history.missed == 0 && !m_history->failure(), "the history has missed packets");
    expect(session.accounts().overtaken() == 0, "the session has missed packets");
    expect(session.verdicts().incidents().all().size() <= model::Incidents::kMost, "too many incidents");
    std::uint64_t disk = 0;
    for (const auto& entry : std::filesystem::directory_iterator(m_folder)) {
        disk += entry.file_size();
    }
    m_diskMost = std::max(m_diskMost, disk);
    // Each file goes on until it is full, and a bit.
    expect(disk <= kHistoryBytes + kHistoryBytes / 16,
           "the history takes " + std::to_string(disk) + " bytes");
    const model::MemoryFigures memory = session.memory();
    std::uint64_t kept = 0; // beside the log, which is full by then, and what is decoded for views
    for (const model::MemoryFigures::Part& part : memory.parts) {
        expect(part.most == 0 || part.bytes <= part.most, std::string(part.key) + " takes too much memory");
        kept += part.key == "log" || part.key == "index" || part.key == "messages" ? 0 : part.bytes;
    }
    const std::uint64_t resident = system::processMemoryBytes().value_or(kept);
    const std::uint64_t beside = resident - std::min(resident, kept);
    m_memoryBase = m_memoryBase == 0 ? beside : m_memoryBase;
    const std::uint64_t days = static_cast<std::uint64_t>(m_elapsed / 24h);
    expect(beside <= m_memoryBase + kMostGrowth + days * kMostGrowthOfDay,
           "memory has grown from " + std::to_string(m_memoryBase) + " to " + std::to_string(beside) +
               " bytes");
    m_memoryMost = std::max(m_memoryMost, resident);
}

std::string Soak::figures() const {
    std::array<char, 200> text{};
    const auto megabytes = [](std::uint64_t bytes) { return static_cast<double>(bytes) / 1e6; };
    std::snprintf(
        text.data(), text.size(),
        "%llu datagrams, %zu incidents, %zu clock steps, memory %.0f MB at most, history %.0f MB at most",
        static_cast<unsigned long long>(m_sent), m_origin.session().verdicts().incidents().all().size(),
        m_clockSteps, megabytes(m_memoryMost), megabytes(m_diskMost));
    return text.data();
}

void Soak::hour(int number, int ofDay) {
    const log::Duration begin = m_elapsed;
    record();
    const auto frames = [](log::Duration time, double rateHz) {
        return static_cast<std::uint64_t>(log::secondsOf(time) * rateHz);
    };
    perform({.frames = frames(40min, 2),
             .restartsCounter = number != 0,
             .clockStep = ofDay % 4 == 0 ? log::Duration(number % 8 == 0 ? 1h : -1h) : log::Duration()});
    const bool isLast = ofDay == 19;
    perform({.frames = frames(17min, 2),
             .isCalm = true,
             .clockStep = ofDay % 5 == 3 ? log::Duration(ofDay % 2 == 0 ? 400ms : -400ms) : log::Duration(),
             .summerTime = isLast ? (m_summerTime == 0 ? 1 : -1) : 0});
    perform({.rateHz = 60,
             .frames = frames(20s, 60),
             .isCalm = ofDay % 2 == 0,
             .restartsCounter = ofDay % 3 == 0});
    checkTake();
    passTo(begin + 1h);
    checkBounds();
}

void Soak::day(int number) {
    constexpr int kHours = 20;
    const log::Duration begin = m_elapsed;
    log::SenderTable& senders = m_origin.log().senders();
    m_computers[0].start(senders, 50'000 + number);
    if (number == 0) {
        m_computers[1].start(senders, 40'000);
    }
    for (int i = 0; i < kHours && m_problem.empty(); ++i) {
        hour(kHours * number + i, i);
    }
    if (!m_problem.empty()) {
        return;
    }
    passTo(begin + 24h);
    expect(m_origin.session().verdicts().all().all.state == model::TakeVerdict::State::Bad,
           "silence for hours is not bad");
}

} // namespace
} // namespace posewire::soak

int main(int argc, char** argv) {
    using namespace posewire;
    int days = 0;
    if (argc == 2) {
        std::from_chars(argv[1], argv[1] + std::strlen(argv[1]), days);
    }
    if (days < 1) {
        std::fprintf(stderr, "usage: soak DAYS\n");
        return 2;
    }
    const std::filesystem::path folder = test::newTemporaryFolder("soak");
    std::string problem;
    {
        soak::Soak soak(folder);
        for (int day = 0; day < days && soak.problem().empty(); ++day) {
            soak.day(day);
        }
        problem = soak.problem();
        std::printf("soak: %s\n", soak.figures().c_str());
    }
    std::filesystem::remove_all(folder);
    if (!problem.empty()) {
        std::fprintf(stderr, "soak: %s\n", problem.c_str());
    }
    return problem.empty() ? 0 : 1;
}
