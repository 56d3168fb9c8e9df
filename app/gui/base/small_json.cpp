// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/small_json.h"

#include "app/gui/theme/words.h"

#include <QJsonArray>
#include <QJsonDocument>

namespace posewire::gui {

namespace {

QJsonValue small(const QJsonValue& value, int depth);

QJsonObject small(const QJsonObject& object, int depth) {
    QJsonObject result;
    for (auto entry = object.begin(); entry != object.end() && result.size() < kMostJsonEntries; ++entry) {
        if (entry.key().size() <= kLongestJsonText) {
            result.insert(entry.key(), small(entry.value(), depth + 1));
        }
    }
    return result;
}

QJsonArray small(const QJsonArray& array, int depth) {
    QJsonArray result;
    for (auto entry = array.begin(); entry != array.end() && result.size() < kMostJsonEntries; ++entry) {
        result.append(small(*entry, depth + 1));
    }
    return result;
}

QJsonValue small(const QJsonValue& value, int depth) {
    const bool isText = value.isString();
    if (depth > kDeepestJson || (isText && value.toString().size() > kLongestJsonText)) {
        return {};
    }
    return value.isObject()  ? QJsonValue(small(value.toObject(), depth))
           : value.isArray() ? QJsonValue(small(value.toArray(), depth))
                             : value;
}

} // namespace

tl::expected<QJsonObject, QString> parseSmallObject(const QByteArray& json) {
    QJsonParseError error;
    const QJsonDocument document = QJsonDocument::fromJson(json, &error);
    if (error.error != QJsonParseError::NoError) {
        return tl::unexpected(tr("%1 at byte %2").arg(error.errorString()).arg(error.offset));
    }
    if (!document.isObject()) {
        return tl::unexpected(tr("it does not begin with {"));
    }
    return small(document.object(), 0);
}

} // namespace posewire::gui
