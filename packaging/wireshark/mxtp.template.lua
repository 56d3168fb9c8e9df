-- SPDX-License-Identifier: GPL-3.0-or-later
-- Dissector for MXTP, the datagrams of MVN real-time network streaming, for Wireshark and tshark 3.6 and newer.
--@origin@
-- To use it, put it into the folder that Wireshark names under Help > About > Folders > Personal Lua Plugins.

local mxtp = Proto("mxtp", "MVN real-time network streaming")
local default_port = 9763
local header_size = 24

--@tables@
-- ---------------------------------------------------------------------------------------------------------------
-- Filter fields: one for each name in the tables; layouts that have a name in common share its field.

local declared, kinds = {}, {}

local function declare(filter, name, kind, description, shown_as)
  if declared[filter] then
    assert(kinds[filter] == kind, filter .. " is declared in two ways")
    return declared[filter]
  end
  declared[filter] = ProtoField.new(name, filter, kind, nil, shown_as or base.NONE, nil, description)
  kinds[filter] = kind
  return declared[filter]
end

local integers = { uint8 = ftypes.UINT8, uint16 = ftypes.UINT16, uint32 = ftypes.UINT32, int32 = ftypes.INT32 }

local function declare_layout(layout)
  for _, field in ipairs(layout) do
    local about = field.text .. " (section " .. field.section .. ")"
    if field.fields then
      field.node = declare(field.filter, field.name, ftypes.NONE, about)
      field.item_node = declare(field.item_filter, field.item, ftypes.NONE, about)
      if field.max then
        field.count_node = declare(field.filter .. ".count", "count", ftypes.UINT32, "items that follow", base.DEC)
      end
      declare_layout(field.fields)
    elseif field.parts then
      field.node = declare(field.filter, field.name, ftypes.NONE, about)
      field.components = {}
      for i, part in ipairs(field.parts) do
        field.components[i] = declare(field.filter .. "." .. part, part, ftypes.FLOAT, about)
      end
    elseif integers[field.kind] then
      local shown_as = field.hexadecimal and base.HEX or base.DEC
      field.node = declare(field.filter, field.name, integers[field.kind], about, shown_as)
    else
      field.node = declare(field.filter, field.name, ftypes.STRING, about)
    end
    if field.name_filter then
      field.name_node = declare(field.name_filter, "name", ftypes.STRING, "what the ID or the place stands for")
    end
  end
end

declare_layout(header_layout)
local type_titles = {}
for type, message in pairs(messages) do
  type_titles[type] = message.title
  for _, layout in pairs(message.forms) do
    declare_layout(layout)
  end
end

local own = {
  type = ProtoField.uint8("mxtp.type", "type", base.DEC, type_titles, nil, "message type"),
  index = ProtoField.uint8("mxtp.datagram", "datagram", base.DEC, nil, 0x7f, "place among the datagrams of the sample"),
  last = ProtoField.bool("mxtp.last", "last", 8, { "yes", "no" }, 0x80, "the last datagram of its sample"),
  tag = ProtoField.none("mxtp.tag", "tag", "one line of the text"),
  tag_name = ProtoField.string("mxtp.tag.name", "name"),
  tag_value = ProtoField.string("mxtp.tag.value", "value"),
  raw = ProtoField.bytes("mxtp.raw", "raw", base.NONE, "payload of an unknown layout"),
  rest = ProtoField.bytes("mxtp.rest", "rest", base.NONE, "bytes that belong to no field"),
  skipped = ProtoField.bytes("mxtp.skipped", "skipped", base.NONE, "bytes of the stream that belong to no datagram"),
  error = ProtoField.string("mxtp.error", "error", base.NONE, "code of the fault"),
  error_offset = ProtoField.uint32("mxtp.error.offset", "offset", base.DEC, nil, nil, "first byte of the fault"),
  notice = ProtoField.string("mxtp.notice", "notice", base.NONE, "code of an oddity"),
  notice_offset = ProtoField.uint32("mxtp.notice.offset", "offset", base.DEC, nil, nil, "first byte of the oddity"),
}

local all_fields, all_experts, error_experts, notice_experts = {}, {}, {}, {}
for _, field in pairs(declared) do all_fields[#all_fields + 1] = field end
for _, field in pairs(own) do all_fields[#all_fields + 1] = field end
mxtp.fields = all_fields
for code, text in pairs(error_texts) do
  error_experts[code] = ProtoExpert.new("mxtp.error." .. code, text, expert.group.MALFORMED, expert.severity.ERROR)
  all_experts[#all_experts + 1] = error_experts[code]
end
for code, text in pairs(notice_texts) do
  notice_experts[code] = ProtoExpert.new("mxtp.notice." .. code, text, expert.group.PROTOCOL, expert.severity.NOTE)
  all_experts[#all_experts + 1] = notice_experts[code]
end
mxtp.experts = all_experts

-- ---------------------------------------------------------------------------------------------------------------
-- What IDs stand for.

local function hand_name(side, place)
  return hand_segments[place] and side .. hand_segments[place]
end

local function extra_name(extra, props)
  if extra <= props then
    return extra <= most_props and "Prop" .. extra or nil
  end
  return hand_name("Left", extra - props) or hand_name("Right", extra - props - #hand_segments)
end

-- Body, props, left hand, right hand. Older senders do not count them: then 23 body segments come first.
local function segment_at(place, header)
  local body, props = header.bodySegments, header.props
  if body == 0 or body + props + header.fingerSegments ~= header.items then
    body = math.min(header.items, #body_segments)
    props = header.items - body
    local both_hands = 2 * #hand_segments
    if props >= both_hands then props = props - both_hands end
  end
  if place <= body then
    return body_segments[place]
  end
  return extra_name(place - body, props)
end

-- Whether the items are all segments of the character in their order.
local function is_in_order(header)
  local first = messages[header.type].forms.standard[1]
  return header.datagramCounter == 0x80 and first.kind == "items" and first.item == "segment"
end

-- Revisions disagree on the IDs from the left foot on: E has 23 and 24 for left foot and toe, and before N props may
-- begin at 24 or at 25. So there the place decides, where it is known.
local function segment_name(id, header, place)
  local may_be_one_more = place and place >= #body_segments - 1
  if place and (id == place or (may_be_one_more and id == place + 1)) and is_in_order(header) then
    return segment_at(place, header)
  end
  if id <= #body_segments then
    return body_segments[id]
  end
  local extra = id - #body_segments
  if header.bodySegments == 0 then
    return extra <= most_props + 1 and extra_name(math.max(extra - 1, 1), most_props) or nil
  end
  return extra - header.props <= header.fingerSegments and extra_name(extra, header.props) or nil
end

local function local_point_name(segment, point)
  return points[segment] and points[segment][point]
end

local function joint_end_name(id)
  local segment = math.floor(id / 256)
  if id % 256 == 0 then
    return body_segments[segment]
  end
  return local_point_name(segment, id % 256)
end

-- Point IDs of type 03 are 256 times the segment plus the point, in older revisions 100 times. One ID may be either,
-- many are not; tags with any ID may follow. Returns how many IDs from the first on fit.
local function leading_run(tvb, header, fits)
  local at, run = header_size, 0
  while run < header.items and at + 4 <= tvb:len() and fits(tvb(at, 4):uint()) do
    at, run = at + 16, run + 1
  end
  return run
end

local last_segment = #body_segments + most_props + 2 * #hand_segments

local function fits_256(id)
  local segment, point = math.floor(id / 256), id % 256
  local has_point = points[segment] and (point == 0 or points[segment][point])
  return segment >= 1 and segment <= last_segment and point <= 14 and (has_point or segment > #body_segments)
end

local function fits_100(id)
  return id >= 100 and id < 2900 and id % 100 <= 14
end

local function find_point_coding(tvb, header)
  if header.type ~= 3 then return end
  local run_256, run_100 = leading_run(tvb, header, fits_256), leading_run(tvb, header, fits_100)
  header.named_points = math.max(run_256, run_100)
  header.point_base = run_256 >= run_100 and 256 or 100
end

local function point_name(id, header, place)
  if not header.point_base or place > header.named_points then return nil end
  return local_point_name(math.floor(id / header.point_base), id % header.point_base)
end

local namers = {
  segment = segment_name,
  unity_segment = function(id, header, place)
    return id <= #body_segments and body_segments[unity_order[id]] or segment_name(id, header, place)
  end,
  point = point_name,
  joint_end = joint_end_name,
}

-- ---------------------------------------------------------------------------------------------------------------
-- Text.

-- Ranges of the second byte of a UTF-8 sequence, and how many bytes follow the first (RFC 3629).
local function sequence_of(lead)
  if lead < 0xc2 or lead > 0xf4 then return nil end
  if lead < 0xe0 then return 1, 0x80, 0xbf end
  if lead < 0xf0 then return 2, lead == 0xe0 and 0xa0 or 0x80, lead == 0xed and 0x9f or 0xbf end
  return 3, lead == 0xf0 and 0x90 or 0x80, lead == 0xf4 and 0x8f or 0xbf
end

-- Offset of the first byte that is not UTF-8, from 0; nil where all is well.
local function first_invalid(text)
  local at = text:find("[\128-\255]")
  while at do
    local following, low, high = sequence_of(text:byte(at))
    if not following or #text - at < following then return at - 1 end
    local second = text:byte(at + 1)
    if second < low or second > high then return at - 1 end
    for k = 2, following do
      local byte = text:byte(at + k)
      if byte < 0x80 or byte > 0xbf then return at - 1 end
    end
    at = text:find("[\128-\255]", at + following + 1)
  end
end

-- Lines of a type 12 text: each with its place in the text and, if it has a colon, its tag; counts stray lines.
local function tags_of(text)
  local tags, stray, stray_at, at = {}, 0, 0, 1
  while at <= #text do
    local newline = text:find("\n", at, true)
    local stop = (newline or #text + 1) - 1
    local line = text:sub(at, stop)
    local colon = line:find(":", 1, true)
    if not colon or not newline then
      if stray == 0 then stray_at = at - 1 end
      stray = stray + 1
    end
    if colon then
      tags[#tags + 1] = { place = at - 1, size = stop - at + 1, name = line:sub(1, colon - 1), colon = colon,
        value = line:sub(colon + 1) }
    end
    at = stop + 2
  end
  return tags, stray, stray_at
end

-- ---------------------------------------------------------------------------------------------------------------
-- Reading by the tables. A reader without `checks` only measures: it needs no tree.

local Reader = {}
Reader.__index = Reader

local function new_reader(tvb, offset, limit, header, checks)
  return setmetatable({ tvb = tvb, offset = offset, limit = limit, header = header, checks = checks }, Reader)
end

-- Wireshark has no empty range behind the last byte.
function Reader:range(offset, size)
  return self.tvb(size == 0 and math.min(offset, self.tvb:len() - 1) or offset, size)
end

function Reader:left()
  return self.limit - self.offset
end

-- Always false, so that `return reader:fail(…)` ends a read.
function Reader:fail(code, need, have)
  self.fault = { code = code, offset = self.offset, need = need, have = have }
  return false
end

function Reader:add_name(field, node, tree, range, id, place)
  local name = namers[field.names](id, self.header, place)
  if name then
    node:append_text(" (" .. name .. ")")
    if field.name_node then
      tree:add(field.name_node, range, name):set_generated()
    end
  end
  return name
end

-- Without control characters, which a terminal would obey.
local function printable(text)
  text = text:gsub("[\0-\31\127]", function(byte) return string.format("\\x%02x", byte:byte()) end)
  return (text:gsub("\xC2([\x80-\x9F])", function(byte) return string.format("\\u%04x", byte:byte()) end))
end

-- Milliseconds as hours, minutes and seconds.
local function clock_text(milliseconds)
  local seconds = math.floor(milliseconds / 1000)
  return string.format("%02d:%02d:%02d.%03d", math.floor(seconds / 3600), math.floor(seconds / 60) % 60, seconds % 60,
    milliseconds % 1000)
end

function Reader:read_integer(field, tree, values)
  if self:left() < field.size then
    return self:fail("fieldTruncated", field.size, self:left())
  end
  if self.checks then
    local range = self.tvb(self.offset, field.size)
    local value = field.kind == "int32" and range:int() or range:uint()
    values[field.name] = value
    local node = tree:add(field.node, range)
    if field.unit ~= "" then node:append_text(" " .. field.unit) end
    if field.filter == "mxtp.timeCode" then node:append_text(" (" .. clock_text(value) .. ")") end
    if field.filter == "mxtp.datagramCounter" then
      node:add(own.index, range)
      node:add(own.last, range)
    end
    if field.names then values.label = self:add_name(field, node, tree, range, value, values.place) or values.label end
    if field.checked and (value < 1 or value > most_segments) then values.is_out_of_range = true end
  end
  self.offset = self.offset + field.size
  return true
end

local function is_finite(value)
  return value == value and value ~= math.huge and value ~= -math.huge
end

function Reader:read_floats(field, tree, values)
  local count = #field.parts
  if self:left() < field.size then
    return self:fail("fieldTruncated", field.size, self:left())
  end
  if self.checks then
    local node = tree:add(field.node, self.tvb(self.offset, field.size))
    local unit = field.unit ~= "" and " " .. field.unit or ""
    local shown, square = {}, 0
    for i = 1, count do
      local range = self.tvb(self.offset + 4 * (i - 1), 4)
      local value = range:float()
      node:add(field.components[i], range):append_text(unit)
      shown[i] = string.format("%.6g", value)
      square = square + value * value
      if not is_finite(value) then values.not_finite = (values.not_finite or 0) + 1 end
    end
    node:set_text(field.name .. ": " .. table.concat(shown, ", ") .. unit)
    if count == 4 and not (math.abs(square - 1) <= 0.02) then values.is_off_unit = true end
    if field.name == "rotation" or field.name == "orientation" then
      local real = count == 4 and self.tvb(self.offset, 4):float() or 0
      values.is_turned = square ~= real or (count == 4 and real ~= 1)
    end
  end
  self.offset = self.offset + field.size
  return true
end

function Reader:add_string(node, tree, offset, size)
  if size == 0 then
    return tree:add(node, self:range(offset, 0), "")
  end
  return tree:add_packet_field(node, self:range(offset, size), ENC_UTF_8 + ENC_STRING)
end

function Reader:add_tags(tree, offset, text)
  for _, tag in ipairs((tags_of(text))) do
    local from = offset + tag.place
    local item = tree:add(own.tag, self:range(from, tag.size))
    item:set_text(printable(text:sub(tag.place + 1, tag.place + tag.size)))
    self:add_string(own.tag_name, item, from, tag.colon - 1)
    self:add_string(own.tag_value, item, from + tag.colon, tag.size - tag.colon)
  end
end

-- Takes `length` bytes of text; `behind` more belong to the field.
function Reader:take_text(field, tree, values, length, behind)
  local text = length > 0 and self.tvb(self.offset, length):raw() or ""
  local bad = first_invalid(text)
  if bad then
    self.offset = self.offset + bad
    return self:fail("badSequence", 0, 0)
  end
  if self.checks then
    values[field.name], values.label = text, text
    local node = self:add_string(field.node, tree, self.offset, length)
    if field.name == "text" then self:add_tags(node, self.offset, text) end
  end
  self.offset = self.offset + length + behind
  return true
end

function Reader:read_prefixed_text(field, tree, values)
  if self:left() < 4 then
    return self:fail("fieldTruncated", 4, self:left())
  end
  local length = self.tvb(self.offset, 4):int()
  if length < 0 or length > self:left() - 4 then
    return self:fail("badLength", length, self:left() - 4)
  end
  self.offset = self.offset + 4
  return self:take_text(field, tree, values, length, 0)
end

function Reader:read_zero_text(field, tree, values)
  local rest = self:left() > 0 and self.tvb(self.offset, self:left()):raw() or ""
  local zero = rest:find("\0", 1, true)
  if not zero then
    return self:fail("unterminatedText", 1, 0)
  end
  return self:take_text(field, tree, values, zero - 1, 1)
end

function Reader:read_rest_text(field, tree, values)
  return self:take_text(field, tree, values, self:left(), 0)
end

function Reader:read_characters(field, tree, values)
  if self:left() < field.size then
    return self:fail("fieldTruncated", field.size, self:left())
  end
  if self.checks then
    local range = self.tvb(self.offset, field.size)
    values[field.name] = range:raw()
    local node = tree:add_packet_field(field.node, range, ENC_ASCII + ENC_STRING)
    if field.filter == "mxtp.id" then
      node:add(own.type, range(4, 2), tonumber(range(4, 2):raw()))
    end
  end
  self.offset = self.offset + field.size
  return true
end

-- Whether an item is a MotionGrid tag in the place of a prop, in revision E: it is not turned and has the number of no
-- prop.
function Reader:is_tag(values)
  local header, id, place = self.header, values.id, values.place
  local counted = header.bodySegments + header.props + header.fingerSegments
  local is_prop = (id >= 24 and id <= 30) or id == place or id == place + 1
  return place > 23 and header.items < 63 and not is_prop and self.first_id ~= 0 and header.type <= 2 and
    counted == 0 and header.datagramCounter == 0x80 and not values.is_turned
end

-- An item and what the checks need to know of it.
function Reader:read_item(field, list, index)
  local values, item = { place = index }, nil
  if self.checks then
    item = list:add(field.item_node, self:range(self.offset, 0))
  end
  local from = self.offset
  local is_read = self:read_layout(field.fields, item, values)
  if self.checks then
    if index == 1 then self.first_id = values.id end
    if values.is_out_of_range and is_read and self:is_tag(values) then values.is_out_of_range = nil end
    local label = field.places and field.places[index] or values.label
    item:set_len(self.offset - from)
    item:set_text(printable(field.item .. " " .. index .. (label and ": " .. label or "")))
    if field.places and label then
      item:add(field.name_node, self:range(from, self.offset - from), label):set_generated()
    end
    if is_read then self.checks:add(values, from) end
  end
  return is_read
end

function Reader:read_list(field, tree, count)
  local list = self.checks and tree:add(field.node, self:range(self.offset, 0))
  local from = self.offset
  local whole = field.size and math.min(count, math.floor(self:left() / field.size)) or count
  local is_read = true
  for index = 1, whole do
    is_read = self:read_item(field, list, index)
    if not is_read then break end
  end
  if is_read and whole < count then
    local stop = self.offset
    if self.checks then self:read_item(field, list, whole + 1) end
    self.offset = stop
    is_read = self:fail("itemsTruncated", (count - whole) * field.size, self.limit - stop)
  end
  if self.checks then
    list:set_len(self.offset - from)
    list:set_text(field.name .. ": " .. count)
    self.checks.shown[#self.checks.shown + 1] = count .. " " .. field.name
  end
  return is_read
end

function Reader:read_items(field, tree)
  if self.header.items == 0 and field.size and self:left() >= field.size then
    return self:fail("noItems", 0, self:left())
  end
  return self:read_list(field, tree, self.header.items)
end

function Reader:read_counted_items(field, tree)
  if self:left() < 4 then
    return self:fail("fieldTruncated", 4, self:left())
  end
  local count = self.tvb(self.offset, 4):uint()
  local room = math.min(field.max, math.floor((self:left() - 4) / field.least))
  if count > room then
    return self:fail("countTooLarge", count, room)
  end
  if self.checks then
    tree:add(field.count_node, self.tvb(self.offset, 4)):set_text(field.name .. " count: " .. count)
  end
  self.offset = self.offset + 4
  return self:read_list(field, tree, count)
end

local read_by_kind = {
  uint8 = Reader.read_integer, uint16 = Reader.read_integer, uint32 = Reader.read_integer, int32 = Reader.read_integer,
  floats = Reader.read_floats, characters = Reader.read_characters, prefixed_text = Reader.read_prefixed_text,
  zero_text = Reader.read_zero_text, rest_text = Reader.read_rest_text, items = Reader.read_items,
  counted_items = Reader.read_counted_items,
}

function Reader:read_layout(layout, tree, values)
  for _, field in ipairs(layout) do
    if not read_by_kind[field.kind](self, field, tree, values) then
      return false
    end
  end
  return true
end

-- ---------------------------------------------------------------------------------------------------------------
-- Oddities: collected while reading, reported in one order.

local Checks = {}
Checks.__index = Checks

local function new_checks()
  return setmetatable({ notices = {}, shown = {}, values = {} }, Checks)
end

function Checks:notice(code, offset, count)
  self.notices[#self.notices + 1] = { code = code, offset = offset, count = count }
end

function Checks:tally(code, offset, count)
  local tally = self[code] or { offset = offset, count = 0 }
  tally.count = tally.count + count
  self[code] = tally
end

function Checks:add(values, start)
  if values.not_finite then
    self:tally("notFinite", start, values.not_finite)
  elseif values.is_off_unit then
    self:tally("notUnitQuaternion", start, 1)
  end
  if values.is_out_of_range then
    self:tally("segmentOutOfRange", start, 1)
  end
end

function Checks:check_header(header)
  if header.reserved ~= 0 then
    self:notice("reservedUsed", 20, 1)
  end
  local counted = header.bodySegments + header.props + header.fingerSegments
  if header.datagramCounter == 0x80 and messages[header.type] and messages[header.type].has_segments and counted ~= 0
      and counted ~= header.items then
    self:notice("countDisagrees", 11, 1)
  end
end

-- 100 or 256 for each segment, and the point; anything else is a tag.
local function may_be_marker(id)
  local function is_point(segment, point)
    return segment >= 1 and segment <= 67 and point >= 1 and point <= 14
  end
  return is_point(math.floor(id / 256), id % 256) or is_point(math.floor(id / 100), id % 100)
end

-- `id_at(place)`: the ID of an item.
function Checks:check_limits(header, id_at)
  local function limit(code, offset, count, most)
    if count > most then self:notice(code, offset, count) end
  end
  limit("tooManyProps", 18, header.props, 4)
  local counted = header.bodySegments + header.props + header.fingerSegments
  if header.type == 5 then
    limit("tooManyItems", 11, header.items, 23)
  elseif header.type == 3 then
    local markers = 0
    for place = 0, header.items > 64 and header.items - 1 or -1 do
      markers = markers + (may_be_marker(id_at(place)) and 1 or 0)
    end
    limit("tooManyPoints", 11, markers, 64)
  elseif messages[header.type] and messages[header.type].has_segments and counted == 0 and header.items < 63 then
    limit("tooManyProps", 11, math.max(header.items, 23) - 23, 4)
  end
end

function Checks:check_tags(text, start)
  local tags, stray, stray_at = tags_of(text)
  for _, tag in ipairs(tags) do
    if not known_tags[tag.name] then self:tally("unknownTag", start + tag.place, 1) end
    if tag.name == "color" and not tag.value:find("^%x%x%x%x%x%x$") then
      self:tally("badColour", start + tag.place + tag.colon, 1)
    end
  end
  for _, code in ipairs({ "unknownTag", "badColour" }) do
    if self[code] then self:notice(code, self[code].offset, self[code].count) end
  end
  if stray > 0 then self:notice("lineWithoutTag", start + stray_at, stray) end
end

function Checks:check_time_code(values)
  if values.length and values.length ~= 12 then
    self:notice("lengthDisagrees", header_size, 1)
  end
  local hours = values.timeCode:match("^(%d%d):[0-5]%d:[0-5]%d%.%d%d%d$")
  if not hours or tonumber(hours) > 23 then
    self:notice("notATimeCode", header_size + (values.length and 4 or 0), 1)
  end
end

function Checks:check_body(type, form, values)
  if type == 12 then
    self:check_tags(values.text, header_size + (form == "standard" and 4 or 0))
  elseif type == 25 then
    self:check_time_code(values)
  end
  self:add(values, header_size)
  for _, code in ipairs({ "notFinite", "notUnitQuaternion", "segmentOutOfRange" }) do
    if self[code] then self:notice(code, self[code].offset, self[code].count) end
  end
end

-- ---------------------------------------------------------------------------------------------------------------
-- Which layout the payload is in. `at(place)` is a byte of the payload, nil behind its end.

local function starts_with_magic(tvb)
  return tvb:len() >= 4 and tvb(0, 4):raw() == "MXTP"
end

local function starts_datagram(tvb)
  return tvb:len() >= 6 and tvb(0, 6):raw():find("^MXTP[%d\0-\9][%d\0-\9]$") ~= nil
end

local function payload_bytes(tvb)
  return function(place)
    return header_size + place < tvb:len() and tvb(header_size + place, 1):uint() or nil
  end
end

local function has_colons(at, first, second)
  return at(first) == 0x3a and at(second) == 0x3a
end

-- Some senders of type 25 leave the length out of their count.
local function sent_payload(header, at, size)
  if header.payloadSize == 0 then
    return size
  end
  local leaves_out = header.type == 25 and header.payloadSize == 12 and has_colons(at, 6, 9)
  return leaves_out and 16 or header.payloadSize
end

-- The short size, or up to three stray bytes more.
local function is_short(header, size, short_size)
  local counted = header.payloadSize ~= 0 and header.payloadSize or size
  return counted >= short_size and counted - short_size < 4
end

local function short_size_of(type, items)
  local short = messages[type].forms.short
  return short[1].size and short[1].fields and items * short[1].size or short[1].size
end

local form_of = {
  [4] = function(header, _, size)
    return size == header.items * messages[4].forms.standard[1].size and "standard" or "raw"
  end,
  [12] = function(_, at, size)
    return size >= 4 and (at(0) == 0 or at(0) >= 0x80) and "standard" or "bare"
  end,
  [23] = function(header, _, size)
    return header.items ~= 0 and is_short(header, size, short_size_of(23, header.items)) and "short" or "standard"
  end,
  [24] = function(header, _, size)
    return is_short(header, size, short_size_of(24)) and "short" or "standard"
  end,
  [25] = function(_, at, size)
    local has_length = size >= 4 and at(0) == 0 and at(1) == 0 and at(2) == 0 and at(3) == 12
    if size >= 16 and has_length then return "standard" end
    if has_colons(at, 2, 5) and size > 5 then return "bare" end
    return (size >= 16 or (has_colons(at, 6, 9) and size > 9) or has_length) and "standard" or "bare"
  end,
}

-- ---------------------------------------------------------------------------------------------------------------
-- One datagram.

-- The header as far as it goes, and the fault if that is not far enough. Nil where there is nothing to show.
local function read_header(tvb, tree, checks)
  if not tvb:raw(0, math.min(6, tvb:len())):find("^MXTP%d%d$") then
    if starts_datagram(tvb) then
      return nil, { code = "typeAsNumber", offset = 4, need = tvb(4, 1):uint() % 16, have = tvb(5, 1):uint() % 16 }
    elseif tvb:len() >= 6 then
      return nil, { code = "badType", offset = 4, need = 2, have = 2 }
    end
    return nil, { code = "headerTruncated", offset = tvb:len(), need = header_size, have = tvb:len() }
  end
  local limit = math.min(tvb:len(), header_size)
  local branch = checks and tree:add(tvb(0, limit), "header")
  local header = {}
  local reader = new_reader(tvb, 0, limit, header, checks or new_checks())
  if not reader:read_layout(header_layout, branch or tree, header) then
    return header, { code = "headerTruncated", offset = tvb:len(), need = header_size, have = tvb:len() }
  end
  return header
end

-- Where the payload ends in `size` bytes with the header, and which layout it is in.
local function extent_and_form(header, at, size)
  local limit = math.min(size, header_size + sent_payload(header, at, size - header_size))
  if not form_of[header.type] then
    return limit, messages[header.type] and "standard" or "raw"
  end
  local within = function(place) return place < limit - header_size and at(place) or nil end
  return limit, form_of[header.type](header, within, limit - header_size)
end

local function read_body(tvb, tree, header, checks)
  local limit, form = extent_and_form(header, payload_bytes(tvb), tvb:len())
  local announced = header_size + header.payloadSize
  local is_cut_off = header.payloadSize ~= 0 and limit < announced
  local message = messages[header.type]
  local reader = new_reader(tvb, header_size, limit, header, checks)
  find_point_coding(tvb, header)
  local is_read = true
  if form == "raw" then
    if limit > header_size then tree:add(own.raw, tvb(header_size, limit - header_size)) end
    reader.offset = limit
    checks:notice(message and "unknownLayout" or "unknownType", message and header_size or 4, 1)
  else
    is_read = reader:read_layout(message.forms[form], tree, checks.values)
  end
  if is_cut_off then
    reader.offset = limit
    reader:fail("payloadTruncated", announced, limit)
    return reader.fault
  end
  if not is_read then
    return reader.fault
  end
  if reader:left() > 0 then
    checks:notice("trailingBytes", reader.offset, reader:left())
    tree:add(own.rest, tvb(reader.offset, reader:left()))
  end
  if tvb:len() > limit then
    tree:add(own.rest, tvb(limit, tvb:len() - limit))
  end
  checks:check_header(header)
  checks:check_limits(header, function(place) return tvb(header_size + 16 * place, 4):uint() end)
  if header.payloadSize ~= 0 and tvb:len() > announced then
    checks:notice("sizeDisagrees", announced, tvb:len() - announced)
  end
  if form ~= "raw" then checks:check_body(header.type, form, checks.values) end
end

local function title_of(header)
  return messages[header.type] and messages[header.type].title or "unknown type"
end

local function info_text(header, checks, fault)
  if not header or not header.type then
    return "malformed"
  end
  local words = { string.format("%02d %s", header.type, title_of(header)) }
  if header.character then words[#words + 1] = "character " .. header.character end
  if header.sample then words[#words + 1] = "sample " .. string.format("%d", header.sample) end
  local index = (header.datagramCounter or 0x80) % 128
  if header.datagramCounter and header.datagramCounter ~= 0x80 then
    words[#words + 1] = "datagram " .. index .. (header.datagramCounter >= 128 and " (last)" or "")
  end
  for _, what in ipairs(checks.shown) do words[#words + 1] = what end
  local time_code = checks.values.timeCode
  if time_code then words[#words + 1] = time_code:gsub("[^ -~]", "?") end
  return table.concat(words, ", ") .. (fault and " [" .. fault.code .. "]" or "")
end

-- A generated line at the byte in question, so that clicking it shows the byte.
local function add_remark(tree, tvb, field, offset_field, experts, code, offset, text)
  local inside = math.max(math.min(offset, tvb:len() - 1), 0)
  local node = tree:add(field, tvb(inside, offset < tvb:len() and 1 or 0), code)
  node:set_generated()
  node:add(offset_field, offset):set_generated()
  node:add_proto_expert_info(experts[code], text)
end

-- ---------------------------------------------------------------------------------------------------------------
-- The quick path, for lists and filters, where nobody sees the tree: checks the whole datagram with one unpacking an
-- item and adds the fields that somebody asks for. It leaves everything odd to the readers above.

local codes = { uint8 = "B", uint16 = "I2", uint32 = "I4", int32 = "i4" }

-- Writes Lua that moves `at` (from 1) over a layout in `raw`, ends with nothing where a datagram is odd, and keeps what
-- the checks and the summary need: numbers and texts outside lists in `values`, sizes of lists in `shown`.
local Script = {}
Script.__index = Script

function Script:line(text, ...)
  self[#self + 1] = select("#", ...) > 0 and text:format(...) or text
end

function Script:keep(field, variable)
  if self.depth == 0 then self:line("values.%s = %s", field.name, variable) end
end

function Script:add_number_checks(field, variables)
  if field.checked then
    self:line("if %s < 1 or %s > %d then return end", variables[1], variables[1], most_segments)
  elseif field.kind == "floats" then
    self:line("sum = %s", table.concat(variables, " + "))
    self:line("if sum - sum ~= 0 then return end") -- with an infinity or a NaN in it
    if #variables == 4 then
      local squares = {}
      for i, variable in ipairs(variables) do squares[i] = variable .. " * " .. variable end
      self:line("if not (abs(%s - 1) <= 0.02) then return end", table.concat(squares, " + "))
    end
  end
end

-- Fields of fixed size that follow each other from `first` on are read at once. Returns the place of the next field.
function Script:add_fixed(layout, first)
  local formats, all, of_field, size, place = {}, {}, {}, 0, first
  while layout[place] and layout[place].size and not layout[place].fields do
    local field = layout[place]
    local format = codes[field.kind] or (field.kind == "floats" and "f" or "c" .. field.size)
    of_field[field] = {}
    for i = 1, field.parts and #field.parts or 1 do
      formats[#formats + 1] = format
      all[#all + 1] = "v" .. #formats
      of_field[field][i] = all[#all]
    end
    size, place = size + field.size, place + 1
  end
  self:line("if stop - at < %d then return end", size)
  self:line("do local %s = unpack('>%s', raw, at)", table.concat(all, ", "), table.concat(formats))
  self:line("at = at + %d", size)
  for i = first, place - 1 do
    self:add_number_checks(layout[i], of_field[layout[i]])
    self:keep(layout[i], of_field[layout[i]][1])
  end
  self:line("end")
  return place
end

function Script:add_count(most)
  self:line("if stop - at < 4 then return end")
  self:line("count, at = unpack('>I4', raw, at), at + 4")
  self:line("if count > %d then return end", most)
end

local text_ends = {
  prefixed_text = "last = at + count - 1 next = last + 1",
  zero_text = "next = find(raw, '\\0', at, true) if not next then return end last = next - 1 next = next + 1",
  rest_text = "last = stop - 1 next = stop",
}

function Script:add_text(field)
  if field.kind == "prefixed_text" then self:add_count(most_bytes) end
  self:line(text_ends[field.kind])
  self:line("if next > stop then return end")
  self:line("do local text = sub(raw, at, last)")
  self:line("if first_invalid(text) then return end")
  self:keep(field, "text")
  self:line("at = next end")
end

function Script:add_list(field)
  if field.max then
    self:add_count(field.max)
  else
    self:line("count = items")
  end
  self:line("shown[#shown + 1] = count .. ' %s'", field.name)
  self:line("for _ = 1, count do")
  self.depth = self.depth + 1
  self:add_layout(field.fields)
  self.depth = self.depth - 1
  self:line("end")
end

function Script:add_layout(layout)
  local place = 1
  while layout[place] do
    local field = layout[place]
    if field.fields then
      self:add_list(field)
    elseif field.size then
      place = self:add_fixed(layout, place) - 1
    else
      self:add_text(field)
    end
    place = place + 1
  end
end

-- A function that checks a layout: (raw, at, stop, items, values, shown). Returns where it ends, nil where it is odd.
local function checker_of(layout)
  local script = setmetatable({ depth = 0 }, Script)
  script:line("local unpack, first_invalid, abs, find, sub = ...")
  script:line("return function(raw, at, stop, items, values, shown)")
  script:line("local sum, count, last, next")
  script:add_layout(layout)
  script:line("return at end")
  local compile = loadstring or load -- by version of Lua
  return assert(compile(table.concat(script, "\n")))(Struct.unpack, first_invalid, math.abs, string.find, string.sub)
end

-- What can be added without reading: leaves with their offset in a part, which is a run of fields or a list of items.
local function add_leaf(leaves, node, field, offset, size, more)
  local leaf = more or {}
  leaf.node, leaf.field, leaf.offset, leaf.size = node, field, offset, size
  leaves[#leaves + 1] = leaf
end

local function add_leaves_of(leaves, field, offset)
  local is_text = field.kind == "characters"
  add_leaf(leaves, field.node, field, offset, field.size, { encoding = is_text and ENC_ASCII + ENC_STRING })
  for i, component in ipairs(field.components or {}) do
    add_leaf(leaves, component, field, offset + 4 * (i - 1), 4)
  end
  if field.name_node then
    add_leaf(leaves, field.name_node, field, offset, field.size, { is_name = true })
  end
  if field.filter == "mxtp.id" then
    add_leaf(leaves, own.type, field, offset + 4, 2, { is_type = true })
  elseif field.filter == "mxtp.datagramCounter" then
    add_leaf(leaves, own.index, field, offset, 1)
    add_leaf(leaves, own.last, field, offset, 1)
  end
end

local function list_part(list)
  local part, offset = { list = list, size = list.size, leaves = {} }, 0
  for _, field in ipairs(list.fields) do
    add_leaves_of(part.leaves, field, offset)
    offset = offset + field.size
  end
  add_leaf(part.leaves, list.item_node, list, 0, list.size)
  if list.places then add_leaf(part.leaves, list.name_node, list, 0, list.size, { is_place = true }) end
  return part
end

local function parts_of(layout)
  local parts, open = {}, nil
  for _, field in ipairs(layout) do
    if field.fields then
      parts[#parts + 1], open = list_part(field), nil
    else
      open = open or { size = 0, leaves = {} }
      if open.size == 0 then parts[#parts + 1] = open end
      add_leaves_of(open.leaves, field, open.size)
      open.size = open.size + field.size
    end
  end
  return parts
end

local function add_nodes(nodes, layout)
  for _, field in ipairs(layout) do
    for _, node in ipairs({ field.node, field.item_node or field.node, field.count_node or field.node,
        field.name_node or field.node }) do
      nodes[#nodes + 1] = node
    end
    for _, component in ipairs(field.components or {}) do nodes[#nodes + 1] = component end
    if field.fields then add_nodes(nodes, field.fields) end
    if field.name == "text" then
      for _, node in ipairs({ own.tag, own.tag_name, own.tag_value }) do nodes[#nodes + 1] = node end
    end
  end
  return nodes
end

-- Layouts of texts have no parts: where one of their fields is asked for, the readers add it.
local function is_fixed(layout)
  for _, field in ipairs(layout) do
    if not field.size or (field.fields and (field.max or not is_fixed(field.fields))) then return false end
  end
  return true
end

local function sheet_of(layout)
  return { check = checker_of(layout), nodes = add_nodes({}, layout), parts = is_fixed(layout) and parts_of(layout) }
end

local header_sheet, sheets = sheet_of(header_layout), {}
for type, message in pairs(messages) do
  sheets[type] = {}
  for form, layout in pairs(message.forms) do sheets[type][form] = sheet_of(layout) end
end

-- The header without a tree; there are `header_size` bytes at least.
local function header_of(raw)
  local header = {}
  header_sheet.check(raw, 1, header_size + 1, 0, header)
  header.type = tonumber(raw:sub(5, 6))
  return header
end

-- The header, the checks and the form of a datagram; nil for an odd one.
local function skim(tvb)
  local raw = tvb:raw()
  if #raw < header_size or not raw:find("^MXTP%d%d") then return nil end
  local header, checks = header_of(raw), new_checks()
  local limit, form = extent_and_form(header, function(place) return raw:byte(header_size + place + 1) end, #raw)
  local sheet = sheets[header.type] and sheets[header.type][form]
  if not sheet or limit < #raw or (header.payloadSize ~= 0 and header_size + header.payloadSize ~= limit) then
    return nil
  end
  local stop = sheet.check(raw, header_size + 1, limit + 1, header.items, checks.values, checks.shown)
  if stop ~= limit + 1 then return nil end
  checks:check_header(header)
  checks:check_limits(header, function(place) return (Struct.unpack(">I4", raw, header_size + 16 * place + 1)) end)
  checks:check_body(header.type, form, checks.values)
  if #checks.notices > 0 then return nil end
  return header, checks, sheet
end

local function name_of_item(leaf, range, header, place)
  if leaf.is_place then return leaf.field.places[place] end
  return namers[leaf.field.names](range:uint(), header, place)
end

local function add_leaf_of_items(tree, tvb, leaf, at, stride, count, header)
  local node, size = leaf.node, leaf.size
  at = at + leaf.offset
  for place = 1, count do
    local range = tvb(at, size)
    if leaf.is_name or leaf.is_place then
      local name = name_of_item(leaf, range, header, place)
      if name then tree:add(node, range, name):set_generated() end
    elseif leaf.encoding then
      tree:add_packet_field(node, range, leaf.encoding)
    elseif leaf.is_type then
      tree:add(node, range, header.type)
    else
      tree:add(node, range)
    end
    at = at + stride
  end
end

local function add_parts(tree, tvb, parts, at, header)
  for _, part in ipairs(parts) do
    local count = part.list and header.items or 1
    if part.list and tree:referenced(part.list.node) then tree:add(part.list.node, tvb(at, count * part.size)) end
    for _, leaf in ipairs(part.leaves) do
      if tree:referenced(leaf.node) then add_leaf_of_items(tree, tvb, leaf, at, part.size, count, header) end
    end
    at = at + count * part.size
  end
end

local function is_asked_for(root, nodes)
  for _, node in ipairs(nodes) do
    if root:referenced(node) then return true end
  end
  return false
end

local function needs_readers(root, sheet, header)
  local list = sheet.parts and sheet.parts[#sheet.parts].list
  local is_plain = sheet.parts and not (list and (header.items == 0 or (list.places and header.items > #list.places)))
  return not is_plain and is_asked_for(root, sheet.nodes)
end

-- Returns the summary; nil where the readers have to do it.
local function dissect_quickly(tvb, root)
  local header, checks, sheet = skim(tvb)
  if not header or needs_readers(root, sheet, header) then return nil end
  local tree = root:add(mxtp, tvb())
  add_parts(tree, tvb, header_sheet.parts, 0, header)
  if sheet.parts then
    find_point_coding(tvb, header)
    add_parts(tree, tvb, sheet.parts, header_size, header)
  end
  return info_text(header, checks)
end

local function filled(text, figures)
  return printable((text:gsub("{(%a+)}", figures)))
end

local function dissect_datagram(tvb, root)
  local quick = not root.visible and dissect_quickly(tvb, root)
  if quick then return quick end
  local tree = root:add(mxtp, tvb())
  local checks = new_checks()
  local header, fault = read_header(tvb, tree, checks)
  if header then
    header.type = tonumber(tvb(4, 2):raw())
  end
  if not fault then
    fault = read_body(tvb, tree, header, checks)
  end
  if fault then
    local text = filled(error_texts[fault.code], fault)
    add_remark(tree, tvb, own.error, own.error_offset, error_experts, fault.code, fault.offset, text)
  else
    for _, notice in ipairs(checks.notices) do
      local text = filled(notice_texts[notice.code], notice)
      if notice.count == 1 then text = text:gsub(", 1 (%a+)s%)$", ", 1 %1)") end
      add_remark(tree, tvb, own.notice, own.notice_offset, notice_experts, notice.code, notice.offset, text)
    end
  end
  local info = info_text(header, checks, fault)
  tree:append_text(": " .. info)
  return info
end

-- ---------------------------------------------------------------------------------------------------------------
-- How long a datagram is in a stream. Returns a size, or nil and "foreign", "more" or "unknown".

-- False where the bytes cannot begin a datagram, whatever follows.
local function may_start(tvb, offset)
  local front = tvb:len() > offset and tvb(offset, math.min(6, tvb:len() - offset)):raw() or ""
  return ("MXTP"):sub(1, #front) == front:sub(1, 4) and front:sub(5):find("^[%d\0-\9]*$") ~= nil
end

local function known(size)
  if size > most_bytes then
    return nil, "unknown"
  end
  return size
end

-- The first of the sizes at which the bytes end or another datagram begins. Senders write datagrams whole, so the end
-- of a segment is taken for the end of a datagram where it can be: waiting would hide the last one of a stream.
local function first_that_fits(tvb, ...)
  for _, size in ipairs({ ... }) do
    if tvb:len() <= size or may_start(tvb, size) then
      return size
    end
  end
  return nil, "unknown"
end

local function walked(tvb, header)
  local reader = new_reader(tvb, header_size, tvb:len(), header)
  if reader:read_layout(messages[header.type].forms.standard) then
    return known(reader.offset)
  end
  local is_hopeless = reader.fault.code == "badSequence"
    or (reader.fault.code == "countTooLarge" and reader.fault.need > most_points)
  return nil, (is_hopeless or tvb:len() >= most_bytes) and "unknown" or "more"
end

local computed = {
  [12] = function(tvb)
    if tvb:len() < header_size + 4 then return nil, "more" end
    local length = tvb(header_size, 4):uint()
    if length > most_bytes then return nil, "unknown" end
    return known(header_size + 4 + length)
  end,
  [11] = walked,
  [13] = walked,
  [23] = function(tvb, header)
    return first_that_fits(tvb, header_size + short_size_of(23, header.items),
      header_size + header.items * messages[23].forms.standard[1].size)
  end,
  [24] = function(tvb) return first_that_fits(tvb, header_size + 12, header_size + 36) end,
  [25] = function(tvb, header)
    if tvb:len() < header_size + 12 then return nil, "more" end
    local form = form_of[25](header, payload_bytes(tvb), tvb:len() - header_size)
    return header_size + (form == "bare" and 12 or 16)
  end,
}

local function extent_of(tvb)
  if not may_start(tvb, 0) then return nil, "foreign" end
  if tvb:len() < header_size then return nil, "more" end
  local header = header_of(tvb(0, header_size):raw())
  if not header.type then return nil, "unknown" end -- sent as a number
  if header.payloadSize ~= 0 then
    if header.type == 25 and header.payloadSize == 12 and tvb:len() < header_size + 12 then
      return nil, "more"
    end
    return known(header_size + sent_payload(header, payload_bytes(tvb), tvb:len() - header_size))
  end
  if computed[header.type] then
    return computed[header.type](tvb, header)
  end
  local message = messages[header.type]
  if not message then return nil, "unknown" end
  return known(header_size + header.items * message.forms.standard[1].size)
end

-- Where the next datagram may begin; the end of the bytes where none does.
local function find_mark(tvb, from)
  local text = from < tvb:len() and tvb(from):raw() or ""
  local at = 1
  while true do
    at = text:find("M", at, true)
    if not at then return tvb:len() end
    if may_start(tvb, from + at - 1) then return from + at - 1 end
    at = at + 1
  end
end

-- Where a datagram of unknown size ends: before the next one, else with the segment; a text lasts until a line ends.
local function end_of_unsized(tvb)
  local mark = find_mark(tvb, header_size)
  local is_text = header_of(tvb(0, header_size):raw()).type == 12
  if is_text and mark + 6 > tvb:len() and tvb(mark - 1, 1):uint() ~= 0x0a then
    return nil
  end
  return mark
end

-- A size, or nil where more of the stream has to come first; the second value is then how much, if that is known.
local function piece_at(tvb, can_wait)
  local size, why = extent_of(tvb)
  if why == "unknown" then
    size = end_of_unsized(tvb)
  end
  if size and size <= tvb:len() then
    return size
  end
  if not can_wait or tvb:len() > most_bytes then
    return tvb:len()
  end
  return nil, size and size - tvb:len() or DESEGMENT_ONE_MORE_SEGMENT
end

local function dissect_stream(tvb, pinfo, root)
  local offset, infos = 0, {}
  local can_wait = pinfo.can_desegment > 0
  while offset < tvb:len() do
    local rest = tvb(offset):tvb()
    if not may_start(rest, 0) then
      local mark = find_mark(rest, 1)
      root:add(mxtp, rest(0, mark)):add(own.skipped, rest(0, mark))
      infos[#infos + 1] = mark .. " bytes that belong to no datagram"
      offset = offset + mark
    else
      local size, missing = piece_at(rest, can_wait)
      if not size then
        pinfo.desegment_offset = offset
        pinfo.desegment_len = missing
        break
      end
      infos[#infos + 1] = dissect_datagram(rest(0, size):tvb(), root)
      offset = offset + size
    end
  end
  return infos
end

-- Relays from TCP, and recorders, join several datagrams in one packet.
local function dissect_packet(tvb, root)
  local offset, infos = 0, {}
  while offset < tvb:len() do
    local rest = tvb(offset):tvb()
    local size = extent_of(rest)
    if not size or size + header_size > rest:len() or not starts_datagram(rest(size):tvb()) then
      size = rest:len()
    end
    infos[#infos + 1] = dissect_datagram(rest(0, size):tvb(), root)
    offset = offset + size
  end
  return infos
end

local port_type_tcp = 2

local function dissect(tvb, pinfo, root)
  local infos
  if pinfo.port_type == port_type_tcp then
    infos = dissect_stream(tvb, pinfo, root)
  elseif starts_with_magic(tvb) then
    infos = dissect_packet(tvb, root)
  else
    return 0
  end
  if #infos > 0 then
    pinfo.cols.protocol = "MXTP"
    pinfo.cols.info:set(table.concat(infos, " | ") .. " ")
    pinfo.cols.info:fence()
  end
  return tvb:len()
end

mxtp.dissector = dissect
DissectorTable.get("udp.port"):add(default_port, mxtp)
DissectorTable.get("tcp.port"):add(default_port, mxtp)

-- On other ports by what the bytes begin with.
local function recognize(tvb, pinfo, root)
  if tvb:len() < header_size or not starts_datagram(tvb) then
    return false
  end
  pinfo.conversation = mxtp
  dissect(tvb, pinfo, root) -- not by `mxtp.dissector`, where a stream can no longer wait for its next segment
  return true
end
mxtp:register_heuristic("udp", recognize)
mxtp:register_heuristic("tcp", recognize)
