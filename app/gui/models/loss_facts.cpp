// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/loss_facts.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/accounting/attribution.h"

#include <QStringList>

#include <algorithm>
#include <array>
#include <numeric>

namespace posewire::gui {

namespace {

using ByCause = std::array<std::uint64_t, model::kLossCauses>;

std::uint64_t& at(ByCause& causes, model::LossCause cause) {
    return causes[static_cast<std::size_t>(cause)];
}

ByCause lostByCause(model::SessionView& view) {
    ByCause sum{};
    for (const model::Stream& stream : view.streams()) {
        const auto lost = stream.lostByCause();
        for (std::size_t i = 0; i < sum.size(); ++i) {
            sum[i] += lost[i];
        }
    }
    return sum;
}

ByCause lostByCause(model::SessionView& view, const model::TimeRange& range) {
    // Gaps of several streams end nearly in order.
    constexpr log::Duration kDisorder = std::chrono::seconds(1);
    ByCause sum{};
    const auto& gaps = view.gaps();
    for (auto gap = gaps.rbegin(); gap != gaps.rend() && gap->toStamp > range.from - kDisorder; ++gap) {
        if (gap->toStamp >= range.from && gap->toStamp < range.to) {
            at(sum, gap->cause) += gap->lost;
        }
    }
    return sum;
}

PropertyValue causes(model::SessionView& view) {
    using enum model::LossCause;
    const auto range = view.range();
    ByCause lost = range ? lostByCause(view, *range) : lostByCause(view);
    const std::uint64_t all = std::accumulate(lost.begin(), lost.end(), std::uint64_t{0});
    const QString toolTip =
        tr("Samples lost, by whose loss it was as far as there is evidence: the network, the sender, this "
           "computer, or unknown. The packet after a gap says why.");
    if (all == 0) {
        return {tr("nothing lost"), Health::Good, toolTip};
    }
    QStringList parts; // those that are nothing only take room
    const auto add = [&](const QString& text, model::LossCause cause) {
        if (at(lost, cause) != 0) {
            parts += text.arg(grouped(at(lost, cause)));
        }
    };
    add(tr("network %1"), Network);
    add(tr("sender %1"), Sender);
    add(tr("here %1"), ThisComputer);
    add(tr("unknown %1"), Unknown);
    return {parts.join(QStringLiteral(" · ")), at(lost, ThisComputer) == 0 ? Health::Warning : Health::Error,
            toolTip};
}

PropertyValue longestGap(model::SessionView& view) {
    const auto range = view.range();
    std::uint64_t longest = 0;
    double rateHz = 0;
    for (const model::Stream& stream : view.streams()) {
        const model::StreamCounts counts =
            range ? stream.accounting.countsBetween(range->from, range->to) : stream.accounting.counts();
        if (counts.longestGapSamples > longest) {
            longest = counts.longestGapSamples;
            rateHz = stream.statistics.rateHz();
        }
    }
    const QString toolTip = tr("Most samples of one stream lost in a row, and how long they would have been "
                               "at the present rate");
    if (longest == 0) {
        return {tr("none"), Health::Good, toolTip};
    }
    const QString samples = longest == 1 ? tr("1 sample") : tr("%1 samples").arg(grouped(longest));
    const QString time =
        rateHz > 0 ? tr(" · %1 ms").arg(fixed(static_cast<double>(longest) / rateHz * 1000, 1)) : QString();
    return {samples + time, Health::Warning, toolTip};
}

} // namespace

std::vector<Property> lossFacts(model::SessionView& view) {
    return {{tr("Lost by cause"), [&view] { return causes(view); }},
            {tr("Longest gap"), [&view] { return longestGap(view); }}};
}

} // namespace posewire::gui
