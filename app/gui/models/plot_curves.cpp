// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/plot_curves.h"

#include "app/gui/models/shown_character.h"
#include "core/feed/series_feed.h"
#include "core/model/session/roster.h"

#include <QJsonArray>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace posewire::gui {

struct CurveBatch {
    struct Wanted {
        PlotCurve* curve; ///< while the batch is made
        feed::CharacterPackets packets;
    };
    feed::SeriesFeed feed;
};

namespace {

/// Rows of each curve: a day at 240 Hz in a scratch file, half an hour and more in memory.
constexpr std::size_t kMostRowsOnDisk = std::size_t{24} * 3600 * 240;
constexpr std::size_t kMostRowsInMemory = std::size_t{1} << 19;
/// Packets that are read at once without a thread.
constexpr std::uint64_t kFew = 4096;
/// As long as there are no more rows in a pixel they are drawn one by one: sums would look like stairs.
constexpr std::size_t kRowsOfPixel = 4;
/// Rows that are looked at for a value, where other signals of the packets have values.
constexpr std::uint64_t kLook = 256;

const feed::Series& seriesOf(const PlotCurve::Part& part) {
    return part.batch->feed.series(part.source);
}

/// x, y and z have their colours, as long as those are free; others none that looks like one of them.
int colourFor(const PlotChart& chart, const std::string& text) {
    constexpr std::array kLookAlikes{4, 2, 0}; // of red, green and blue
    const auto has = [&](int colour) {
        return std::ranges::any_of(chart.curves, [=](const PlotCurve& one) { return one.colour == colour; });
    };
    const std::size_t dot = text.find_last_of('.');
    const char after = dot + 1 < text.size() ? text[dot + 1] : ' ';
    const bool isLetterAlone = dot + 2 >= text.size() || text[dot + 2] == ' ' || text[dot + 2] == ')';
    if (isLetterAlone && after >= 'x' && after <= 'z' && !has(kPlotColours + (after - 'x'))) {
        return kPlotColours + (after - 'x');
    }
    for (const bool mayLookAlike : {false, true}) {
        for (int colour = 0; colour < kPlotColours; ++colour) {
            const auto axis = std::ranges::find(kLookAlikes, colour) - kLookAlikes.begin();
            const bool isAlike = axis < 3 && has(kPlotColours + static_cast<int>(axis));
            if (!has(colour) && (mayLookAlike || !isAlike)) {
                return colour;
            }
        }
    }
    return static_cast<int>(chart.curves.size()) % kPlotColours;
}

/// Curves without a unit stand together only if they are of the same field.
bool belongTogether(const feed::Expression& a, const feed::Expression& b) {
    const auto field = [](const std::string& text) { return text.substr(0, text.find_first_of(". (")); };
    return a.unit == b.unit && (!a.unit.empty() || field(a.text) == field(b.text));
}

void append(QByteArray& text, double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    text.append(digits.data(), end - digits.data());
}

QByteArray quoted(QString text) {
    return '"' + text.replace(QLatin1Char('"'), QStringLiteral("\"\"")).toUtf8() + '"';
}

} // namespace

QString PlotChart::unit() const {
    const bool isOne = std::ranges::all_of(curves, [this](const PlotCurve& curve) {
        return curve.expression.unit == curves.front().expression.unit;
    });
    return isOne && !curves.empty() ? QString::fromStdString(curves.front().expression.unit) : QString();
}

std::size_t PlotCurves::count() const {
    std::size_t count = 0;
    for (const PlotChart& chart : m_charts) {
        count += chart.curves.size();
    }
    return count;
}

std::optional<filter::FilterError> PlotCurves::add(const QString& text, std::optional<std::size_t> chart,
                                                   std::optional<int> character) {
    auto expression = feed::parseSignal(text.toStdString());
    if (!expression) {
        return expression.error();
    }
    if (count() >= kMostCurves) {
        return filter::FilterError{0, 0, "There are as many curves as can be shown."};
    }
    const auto shown = shownCharacter(m_view);
    if (!character && shown) {
        character = shown->character;
    }
    const auto isSame = [&](const PlotCurve& curve) {
        return curve.expression.text == expression->text && curve.character == character;
    };
    const auto takes = [&](const PlotChart& one) {
        return one.curves.size() < kCurvesOfChart &&
               std::ranges::all_of(one.curves, [&](const PlotCurve& curve) {
                   return belongTogether(curve.expression, *expression);
               });
    };
    auto place = chart ? m_charts.begin() + static_cast<std::ptrdiff_t>(*chart)
                       : std::ranges::find_if(m_charts, [&](const PlotChart& one) {
                             return std::ranges::any_of(one.curves, isSame);
                         });
    place = place == m_charts.end() ? std::ranges::find_if(m_charts, takes) : place;
    place = place == m_charts.end() ? m_charts.emplace(m_charts.end()) : place;
    if (std::ranges::none_of(place->curves, isSame)) {
        const int colour = colourFor(*place, expression->text);
        place->curves.push_back({std::move(*expression), character, {}, colour});
        ++m_changes;
    }
    return std::nullopt;
}

void PlotCurves::remove(std::size_t chart, std::size_t curve) {
    pause();
    auto& curves = m_charts[chart].curves;
    curves.erase(curves.begin() + static_cast<std::ptrdiff_t>(curve));
    if (curves.empty()) {
        m_charts.erase(m_charts.begin() + static_cast<std::ptrdiff_t>(chart));
    }
    ++m_changes;
}

void PlotCurves::moveApart(std::size_t chart, std::size_t curve) {
    PlotCurve moved = m_charts[chart].curves[curve];
    remove(chart, curve);
    moved.colour = colourFor({}, moved.expression.text);
    m_charts.emplace_back().curves.push_back(std::move(moved));
}

void PlotCurves::setRange(std::size_t chart, std::optional<std::pair<double, double>> range) {
    m_charts[chart].range = range;
    ++m_changes;
}

void PlotCurves::toggleLog(std::size_t chart) {
    m_charts[chart].isLog = !m_charts[chart].isLog;
    setRange(chart, std::nullopt);
}

void PlotCurves::clear() {
    pause();
    m_charts.clear();
    ++m_changes;
}

/// Those on the air that the signal reads; of a plain field one alone, poses before others.
std::vector<std::uint8_t> PlotCurves::typesOf(const PlotCurve& curve, const model::CharacterKey& key) {
    std::vector<std::uint8_t> types;
    for (const std::uint8_t type : curve.expression.types) {
        if (m_view.roster().find(log::StreamKey{key.sender, key.character, type}) != nullptr) {
            types.push_back(type);
        }
    }
    const std::string& text = curve.expression.text;
    const bool isComputed =
        text.find_first_of("(+*/") != std::string::npos || text.find(" - ") != std::string::npos;
    if (!isComputed && !types.empty()) {
        const auto pose = std::ranges::find(types, wire::PoseQuaternion::kType);
        types = {pose == types.end() ? types.front() : *pose};
    }
    return types;
}

/// Whose curve it is.
void PlotCurves::find(PlotCurve& curve) {
    const auto shown = curve.key ? std::nullopt : shownCharacter(m_view);
    if (shown && curve.character.value_or(shown->character) == shown->character) {
        curve.key = shown;
    }
    for (const model::Character* one : m_view.roster().listed()) {
        if (!curve.key && curve.character == int{one->key.character}) {
            curve.key = one->key;
        }
    }
    curve.character = curve.key ? std::optional(int{curve.key->character}) : curve.character;
}

/// Curves whose stream is there, and not read yet.
void PlotCurves::readNew() {
    std::vector<CurveBatch::Wanted> wanted;
    for (PlotChart& chart : m_charts) {
        for (PlotCurve& curve : chart.curves) {
            find(curve);
            for (const model::Character* one :
                 curve.key ? m_view.roster().lineage(*curve.key) : std::vector<const model::Character*>()) {
                const bool isRead = std::ranges::any_of(
                    curve.parts, [&](const auto& part) { return part.sender == one->key.sender; });
                auto types = isRead ? std::vector<std::uint8_t>() : typesOf(curve, one->key);
                if (!isRead && (!types.empty() || curve.expression.types.empty())) {
                    wanted.push_back({&curve, {one->key.sender, one->key.character, std::move(types)}});
                }
            }
        }
    }
    if (wanted.empty()) {
        return;
    }
    const bool isOnDisk = m_view.log().scratch()->hasFile();
    std::vector<feed::SeriesSource> sources;
    for (const CurveBatch::Wanted& one : wanted) {
        const auto isOfSame = [&](const feed::SeriesSource& source) {
            const auto& packets = std::get<feed::CharacterPackets>(source.packets);
            return packets.sender == one.packets.sender && packets.types == one.packets.types &&
                   packets.character == one.packets.character;
        };
        auto source = std::ranges::find_if(sources, isOfSame);
        if (source == sources.end()) {
            source =
                sources.insert(source, {one.packets, {}, isOnDisk ? kMostRowsOnDisk : kMostRowsInMemory});
            const model::Sender* sender = m_view.roster().find(one.packets.sender);
            if (sender != nullptr && !one.packets.types.empty()) {
                source->positionUnit = sender->positionUnit(one.packets.types.front());
            }
        }
        one.curve->parts.push_back({nullptr, static_cast<std::size_t>(source - sources.begin()),
                                    source->curves.size(), one.packets.sender});
        source->curves.push_back(one.curve->expression.signal);
    }
    m_batches.push_back(
        std::make_shared<CurveBatch>(feed::SeriesFeed(m_view.log(), m_view.begin(), std::move(sources))));
    for (const CurveBatch::Wanted& one : wanted) {
        for (PlotCurve::Part& part : one.curve->parts) {
            part.batch = part.batch == nullptr ? m_batches.back() : part.batch;
        }
    }
    ++m_changes;
}

void PlotCurves::pause() {
    if (m_reading.valid()) {
        m_isWanted = true;
        m_reading.get();
        m_isWanted = false;
    }
}

void PlotCurves::refresh() {
    pause();
    std::erase_if(m_batches, [](const auto& batch) { return batch.use_count() == 1; });
    readNew();
    resume();
}

void PlotCurves::resume() {
    if (m_reading.valid()) {
        return;
    }
    const std::uint64_t end = m_view.end();
    std::uint64_t left = 0;
    m_read = 0;
    for (const auto& batch : m_batches) {
        while (end - std::min(end, batch->feed.position()) <= kFew && batch->feed.advance(end)) {
        }
        left = std::max(left, end - std::min(end, batch->feed.position()));
        m_read += batch->feed.position();
    }
    const std::uint64_t all = std::max(end - m_view.begin(), left);
    m_share = left == 0 ? 1 : 1 - static_cast<double>(left) / static_cast<double>(all);
    if (left != 0) {
        m_reading = std::async(std::launch::async, [this, end, batches = m_batches] {
            for (const auto& batch : batches) {
                while (!m_isWanted && batch->feed.advance(end)) {
                }
            }
        });
    }
}

namespace {

/// Rows of a window, and one beside it on either side.
void addRows(std::vector<PlotPoint>& points, const feed::Series& series, std::size_t signal,
             const model::TimeRange& window) {
    const std::uint64_t from = series.rowFrom(window.from);
    const std::uint64_t to = std::min(series.end(), series.rowFrom(window.to) + 1);
    bool followsGap = false;
    for (std::uint64_t i = from - std::min<std::uint64_t>(from - series.begin(), 1); i < to; ++i) {
        const feed::SeriesRow& row = series.row(i);
        const double value = series.value(signal, i);
        followsGap = followsGap || row.followsGap;
        if (std::isfinite(value)) {
            points.push_back(
                {log::secondsOf(row.stamp - window.from), value, value, std::exchange(followsGap, false)});
        }
    }
}

/// Sums of parts that stay the same while the window moves, so that peaks do not flicker.
void addColumns(std::vector<PlotPoint>& points, const feed::Series& series, std::size_t signal,
                const model::TimeRange& window, std::size_t pixels) {
    const log::Duration width =
        std::max(log::Duration(1), (window.to - window.from) / static_cast<std::int64_t>(pixels));
    const log::Stamp first = window.from - window.from.time_since_epoch() % width;
    const auto columns =
        series.columns(signal, {first, first + static_cast<std::int64_t>(pixels + 1) * width}, pixels + 1);
    bool followsGap = false;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        followsGap = followsGap || columns[i].hasGap;
        if (columns[i].count != 0 && std::isfinite(columns[i].least) && std::isfinite(columns[i].most)) {
            points.push_back(
                {log::secondsOf(first + static_cast<std::int64_t>(i) * width + width / 2 - window.from),
                 columns[i].least, columns[i].most, std::exchange(followsGap, false)});
        }
    }
}

} // namespace

std::vector<PlotPoint> PlotCurves::points(const PlotCurve& curve, const model::TimeRange& window,
                                          std::size_t pixels) {
    pause();
    std::vector<PlotPoint> points;
    for (const PlotCurve::Part& part : curve.parts) {
        const feed::Series& series = seriesOf(part);
        if (series.rowFrom(window.to) - series.rowFrom(window.from) <= kRowsOfPixel * pixels) {
            addRows(points, series, part.signal, window);
        } else {
            addColumns(points, series, part.signal, window, pixels);
        }
    }
    std::ranges::stable_sort(points, {}, &PlotPoint::seconds);
    return points;
}

std::optional<PlotValue> PlotCurves::valueAt(const PlotCurve& curve, log::Stamp stamp) {
    pause();
    std::optional<PlotValue> newest;
    for (const PlotCurve::Part& part : curve.parts) {
        const feed::Series& series = seriesOf(part);
        const std::uint64_t end = series.rowFrom(stamp + log::Duration(1));
        for (std::uint64_t row = end; row > series.begin() && row + kLook > end; --row) {
            const feed::SeriesRow& at = series.row(row - 1);
            const double value = series.value(part.signal, row - 1);
            if (std::isnan(value)) {
                continue;
            }
            const bool isBeforeGap = row < series.end() && series.row(row).followsGap;
            const log::Duration usual =
                row - 1 > series.begin() ? at.stamp - series.row(row - 2).stamp : log::Duration(0);
            const bool isInGap = isBeforeGap && stamp - at.stamp > 2 * usual;
            const bool isOld = log::secondsOf(stamp - at.stamp) >= kStaleAge;
            if (!isInGap && !isOld && (!newest || newest->row.stamp < at.stamp)) {
                newest = PlotValue{value, at};
            }
            break;
        }
    }
    return newest;
}

std::optional<QByteArray> PlotCurves::csv(const model::TimeRange& window, std::size_t most) {
    pause();
    struct Column {
        const PlotCurve* curve;
        const PlotCurve::Part* part;
        std::uint64_t row;
        std::uint64_t end;
    };
    std::vector<Column> columns;
    QByteArray text = "time_s,packet,sample";
    std::size_t values = 0;
    for (const PlotChart& chart : m_charts) {
        for (const PlotCurve& curve : chart.curves) {
            const QString unit = QString::fromStdString(curve.expression.unit);
            text += ',' +
                    quoted(unit.isEmpty() ? curve.text() : curve.text() + QStringLiteral(" [%1]").arg(unit));
            for (const PlotCurve::Part& part : curve.parts) {
                const feed::Series& series = seriesOf(part);
                columns.push_back({&curve, &part, series.rowFrom(window.from), series.rowFrom(window.to)});
                values += columns.back().end - columns.back().row;
            }
        }
    }
    text += '\n';
    const auto packetOf = [](const Column& column) {
        return column.row < column.end ? seriesOf(*column.part).row(column.row).packet : UINT64_MAX;
    };
    for (; values <= most && !columns.empty();) {
        const std::uint64_t packet = packetOf(*std::ranges::min_element(columns, {}, packetOf));
        if (packet == UINT64_MAX) {
            break;
        }
        QByteArray cells;
        feed::SeriesRow row;
        for (Column& column : columns) {
            const bool isNext = &column == columns.data() || column.curve != (&column - 1)->curve;
            cells += isNext ? "," : "";
            if (packetOf(column) == packet) {
                row = seriesOf(*column.part).row(column.row);
                const double value = seriesOf(*column.part).value(column.part->signal, column.row++);
                std::isnan(value) ? void() : append(cells, value);
            }
        }
        append(text, log::secondsOf(row.stamp - m_view.firstStamp()));
        text += ',' + QByteArray::number(row.packet) + ',' + QByteArray::number(row.sample) + cells + '\n';
    }
    return values <= most ? std::optional(text) : std::nullopt;
}

QJsonObject PlotCurves::state() const {
    QJsonArray charts;
    for (const PlotChart& chart : m_charts) {
        QJsonArray curves;
        for (const PlotCurve& curve : chart.curves) {
            QJsonObject one{{QStringLiteral("signal"), curve.text()}};
            if (curve.character) {
                one[QStringLiteral("character")] = *curve.character;
            }
            curves += one;
        }
        QJsonObject one{{QStringLiteral("curves"), curves}, {QStringLiteral("log"), chart.isLog}};
        if (chart.range) {
            one[QStringLiteral("range")] = QJsonArray{chart.range->first, chart.range->second};
        }
        charts += one;
    }
    return charts.isEmpty() ? QJsonObject() : QJsonObject{{QStringLiteral("charts"), charts}};
}

bool PlotCurves::restore(const QJsonObject& state) {
    clear();
    for (const QJsonValue& chart : state[QStringLiteral("charts")].toArray()) {
        m_charts.emplace_back();
        for (const QJsonValue& curve : chart[QStringLiteral("curves")].toArray()) {
            const int id = curve[QStringLiteral("character")].toInt(-1);
            add(curve[QStringLiteral("signal")].toString(), m_charts.size() - 1,
                id >= 0 && id <= UINT8_MAX ? std::optional(id) : std::nullopt);
        }
        if (m_charts.back().curves.empty()) {
            m_charts.pop_back();
            continue;
        }
        m_charts.back().isLog = chart[QStringLiteral("log")].toBool();
        const QJsonArray range = chart[QStringLiteral("range")].toArray();
        if (range.size() == 2 && range[0].toDouble() < range[1].toDouble()) {
            m_charts.back().range.emplace(range[0].toDouble(), range[1].toDouble());
        }
    }
    return !m_charts.empty();
}

} // namespace posewire::gui
