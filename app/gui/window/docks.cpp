// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/docks.h"

#include "app/gui/saving.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/icons.h"
#include "app/gui/theme/plain_text.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"

#include <QDockWidget>
#include <QHBoxLayout>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QPainter>
#include <QScrollArea>
#include <QToolButton>

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

namespace posewire::gui {

namespace {

constexpr int kLeastCharacters = 54;
constexpr double kDefaultExtent = 0.22;

const std::array<std::pair<const char*, Qt::DockWidgetArea>, 3> kAreas{
    {{"left", Qt::LeftDockWidgetArea},
     {"right", Qt::RightDockWidgetArea},
     {"bottom", Qt::BottomDockWidgetArea}}};

/// {"docks": ["characters"], "share": 3}
DockLayout::Place placeOf(const QJsonObject& object) {
    DockLayout::Place place;
    place.share = std::max(1, object["share"].toInt(1));
    for (const auto& dock : object["docks"].toArray()) {
        place.docks += dock.toString();
    }
    return place;
}

Qt::Orientation orientationOf(Qt::DockWidgetArea area) {
    return area == Qt::BottomDockWidgetArea ? Qt::Horizontal : Qt::Vertical;
}

/// The first dock of the place, with the others as tabs behind it; null where the program has none of them.
QDockWidget* putPlace(const DockLayout::Place& place, Qt::DockWidgetArea area, QMainWindow& window) {
    QDockWidget* first = nullptr;
    for (const QString& name : place.docks) {
        auto* dock = window.findChild<QDockWidget*>(name, Qt::FindDirectChildrenOnly);
        if (dock == nullptr) {
            continue;
        }
        window.addDockWidget(area, dock, orientationOf(area));
        dock->setVisible(true);
        if (first != nullptr) {
            window.tabifyDockWidget(first, dock);
        } else {
            first = dock;
        }
    }
    if (first != nullptr) {
        first->raise();
    }
    return first;
}

void sizeArea(Qt::DockWidgetArea area, double share, QMainWindow& window,
              const std::vector<std::pair<QDockWidget*, int>>& docks) {
    const bool isBottom = area == Qt::BottomDockWidgetArea;
    const int across = isBottom ? window.height() : window.width();
    const int along = isBottom ? window.width() : window.height();
    const int total = std::accumulate(docks.begin(), docks.end(), 0,
                                      [](int sum, const auto& dock) { return sum + dock.second; });
    QList<QDockWidget*> widgets;
    QList<int> lengths;
    for (const auto& [dock, weight] : docks) {
        widgets += dock;
        lengths += along * weight / std::max(1, total);
    }
    if (widgets.isEmpty()) {
        return;
    }
    // A share of a small window would cut its tables: a column of docks has room for words, up to a third.
    const int words = isBottom ? 0 : window.fontMetrics().averageCharWidth() * kLeastCharacters;
    const int extentNow = std::max(static_cast<int>(across * share), std::min(words, across / 3));
    window.resizeDocks({widgets.front()}, {extentNow}, isBottom ? Qt::Vertical : Qt::Horizontal);
    window.resizeDocks(widgets, lengths, orientationOf(area));
}

QToolButton* flatButton(const QString& name, QWidget* parent) {
    auto* button = new QToolButton(parent);
    button->setProperty("flat", true);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::NoFocus);
    button->setAccessibleName(name);
    button->setToolTip(toolTipText(name));
    button->setVisible(false);
    return button;
}

constexpr int kLeastLines = 3;

/// What the content needs at a width without being squeezed.
int leastHeight(const QWidget& content, int width) {
    const QLayout* layout = content.layout();
    const bool isWrapping = layout != nullptr && layout->hasHeightForWidth();
    return isWrapping ? layout->totalMinimumHeightForWidth(width) : content.minimumSizeHint().height();
}

class DockScroll final : public QScrollArea {
public:
    DockScroll(QWidget* content, QWidget* parent) : QScrollArea(parent) {
        setFrameShape(QFrame::NoFrame);
        setFocusPolicy(Qt::NoFocus);
        setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
        setWidget(content);
    }

    [[nodiscard]] QSize sizeHint() const override {
        return widget()->sizeHint().expandedTo(minimumSizeHint());
    }
    [[nodiscard]] QSize minimumSizeHint() const override {
        const QSize content = widget()->minimumSizeHint();
        return {content.width(), std::min(content.height(), fontMetrics().height() * kLeastLines)};
    }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        const bool isDone = QScrollArea::eventFilter(watched, event);
        if (watched == widget() && event->type() == QEvent::LayoutRequest) {
            fitContent();
            updateGeometry();
        }
        return isDone;
    }
    void resizeEvent(QResizeEvent* event) override {
        QScrollArea::resizeEvent(event);
        fitContent();
    }

private:
    /// QScrollArea's own fitting would give content with wrapped texts the height it likes best.
    void fitContent() {
        const int width = viewport()->width();
        const int height = std::max(maximumViewportSize().height(), leastHeight(*widget(), width));
        widget()->resize(width, height);
    }
};

} // namespace

QStringList layoutNames() {
    return {QStringLiteral("Check"), QStringLiteral("Debug"), QStringLiteral("Inspect")};
}

tl::expected<DockLayout, QString> parseLayout(const QByteArray& json) {
    QJsonParseError error;
    const QJsonDocument document = QJsonDocument::fromJson(json, &error);
    if (!document.isObject()) {
        return tl::unexpected(tr("not a layout: %1 at byte %2").arg(error.errorString()).arg(error.offset));
    }
    DockLayout layout;
    layout.name = document.object()["name"].toString();
    const QJsonObject areas = document.object()["areas"].toObject();
    for (const auto& [name, area] : kAreas) {
        const QJsonObject object = areas[QLatin1String(name)].toObject();
        DockLayout::Area read{std::clamp(object["extent"].toDouble(kDefaultExtent), 0.05, 0.8), {}};
        for (const auto& place : object["places"].toArray()) {
            read.places.push_back(placeOf(place.toObject()));
        }
        if (!read.places.empty()) {
            layout.areas[area] = read;
        }
    }
    if (layout.areas.empty()) {
        return tl::unexpected(tr("not a layout: it places no dock"));
    }
    return layout;
}

tl::expected<DockLayout, QString> findLayout(const QString& nameOrFile) {
    const bool isShipped = layoutNames().contains(nameOrFile, Qt::CaseInsensitive);
    const auto content =
        readSmallFile(isShipped ? QStringLiteral(":/layouts/%1.json").arg(nameOrFile.toLower()) : nameOrFile);
    if (!content) {
        return tl::unexpected(
            tr("Layout '%1' is none of %2, and no file that can be read: %3")
                .arg(nameOrFile, layoutNames().join(QStringLiteral(", ")), content.error()));
    }
    return parseLayout(*content).map_error(
        [&](const QString& text) { return nameOrFile + QStringLiteral(": ") + text; });
}

QStringList unknownDocks(const DockLayout& layout, const QStringList& docks) {
    QStringList unknown;
    for (const auto& [side, area] : layout.areas) {
        for (const DockLayout::Place& place : area.places) {
            std::ranges::copy_if(place.docks, std::back_inserter(unknown),
                                 [&](const QString& dock) { return !docks.contains(dock); });
        }
    }
    return unknown;
}

QStringList applyLayout(const DockLayout& layout, QMainWindow& window) {
    QStringList names;
    for (QDockWidget* dock : window.findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly)) {
        names += dock->objectName();
        dock->setFloating(false);
        window.removeDockWidget(dock);
    }
    for (const auto& [side, area] : layout.areas) {
        std::vector<std::pair<QDockWidget*, int>> docks;
        for (const DockLayout::Place& place : area.places) {
            if (QDockWidget* dock = putPlace(place, side, window); dock != nullptr) {
                docks.emplace_back(dock, place.share);
            }
        }
        sizeArea(side, area.extent, window, docks);
    }
    return unknownDocks(layout, names);
}

DockTitle::DockTitle(QDockWidget* dock)
    : QWidget(dock),
      m_title(plainLabel(dock->windowTitle(), this)),
      m_summary(new ElidedLabel(Qt::AlignRight, this)),
      m_float(flatButton(tr("Float or dock"), this)),
      m_close(flatButton(tr("Close"), this)) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(10, 0, 8, 1);
    row->setSpacing(2);
    row->addWidget(m_title);
    row->addSpacing(8);
    row->addWidget(m_summary, 1);
    row->addSpacing(2);
    row->addWidget(m_float);
    row->addWidget(m_close);
    connect(m_float, &QToolButton::clicked, dock, [dock] { dock->setFloating(!dock->isFloating()); });
    connect(m_close, &QToolButton::clicked, dock, &QDockWidget::close);
    new EventWatch(this, QEvent::PaletteChange, [this] { restyle(); });
    new EventWatch(this, QEvent::Enter, [this] { showButtons(true); });
    new EventWatch(this, QEvent::Leave, [this] { showButtons(false); });
    restyle();
}

void DockTitle::restyle() {
    QFont font = this->font();
    font.setWeight(QFont::DemiBold);
    m_title->setFont(font);
    m_summary->setFont(tabularFont());
    const int side = fontMetrics().height() - 2;
    for (auto* button : {m_float, m_close}) {
        button->setIconSize({side, side});
    }
    m_float->setIcon(themedIcon(QStringLiteral("float"), theme().dim));
    m_close->setIcon(themedIcon(QStringLiteral("close"), theme().dim));
    updateGeometry();
}

QSize DockTitle::sizeHint() const {
    return {QWidget::sizeHint().width(), fontMetrics().height() + 13};
}

QSize DockTitle::minimumSizeHint() const {
    return {m_title->sizeHint().width() + 18, sizeHint().height()};
}

void DockTitle::setSummary(const QString& summary) {
    m_summary->setText({}, summary);
}

void DockTitle::showButtons(bool isShown) {
    m_float->setVisible(isShown);
    m_close->setVisible(isShown);
}

void DockTitle::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.fillRect(rect(), theme().header);
    painter.fillRect(QRect(0, height() - 1, width(), 1), theme().line);
}

QWidget* scrolling(QWidget* content, QDockWidget* dock) {
    return new DockScroll(content, dock);
}

} // namespace posewire::gui
