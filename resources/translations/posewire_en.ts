<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en_US">
<context>
    <name>posewire::core</name>
    <message numerus="yes">
        <source>bytes after the last field (byte {offset}, {count} bytes)</source>
        <translation>
            <numerusform>bytes after the last field (byte {offset}, {count} byte)</numerusform>
            <numerusform>bytes after the last field (byte {offset}, {count} bytes)</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>longer than the payload size in the header (byte {offset}, {count} bytes)</source>
        <translation>
            <numerusform>longer than the payload size in the header (byte {offset}, {count} byte)</numerusform>
            <numerusform>longer than the payload size in the header (byte {offset}, {count} bytes)</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>not a finite number (byte {offset}, {count} values)</source>
        <translation>
            <numerusform>not a finite number (byte {offset}, {count} value)</numerusform>
            <numerusform>not a finite number (byte {offset}, {count} values)</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>quaternion is not of unit length (byte {offset}, {count} quaternions)</source>
        <translation>
            <numerusform>quaternion is not of unit length (byte {offset}, {count} quaternion)</numerusform>
            <numerusform>quaternion is not of unit length (byte {offset}, {count} quaternions)</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>segment ID is not in 1 to 67 (byte {offset}, {count} segments)</source>
        <translation>
            <numerusform>segment ID is not in 1 to 67 (byte {offset}, {count} segment)</numerusform>
            <numerusform>segment ID is not in 1 to 67 (byte {offset}, {count} segments)</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>tag not known (byte {offset}, {count} tags)</source>
        <translation>
            <numerusform>tag not known (byte {offset}, {count} tag)</numerusform>
            <numerusform>tag not known (byte {offset}, {count} tags)</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>line that is not &quot;tag:value&quot; (byte {offset}, {count} lines)</source>
        <translation>
            <numerusform>line that is not &quot;tag:value&quot; (byte {offset}, {count} line)</numerusform>
            <numerusform>line that is not &quot;tag:value&quot; (byte {offset}, {count} lines)</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>posewire::gui</name>
    <message numerus="yes">
        <source>%1 samples</source>
        <translation>
            <numerusform>%1 sample</numerusform>
            <numerusform>%1 samples</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1 bytes</source>
        <translation>
            <numerusform>%1 byte</numerusform>
            <numerusform>%1 bytes</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n bytes</source>
        <translation>
            <numerusform>%n byte</numerusform>
            <numerusform>%n bytes</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n characters</source>
        <translation>
            <numerusform>%n character</numerusform>
            <numerusform>%n characters</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>· %n changes</source>
        <translation>
            <numerusform>· %n change</numerusform>
            <numerusform>· %n changes</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1 body · %n props · %2 fingers</source>
        <translation>
            <numerusform>%1 body · %n prop · %2 fingers</numerusform>
            <numerusform>%1 body · %n props · %2 fingers</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1 samples are missing just before it.</source>
        <translation>
            <numerusform>%1 sample is missing just before it.</numerusform>
            <numerusform>%1 samples are missing just before it.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n more characters are not whole either</source>
        <translation>
            <numerusform>%n more character is not whole either</numerusform>
            <numerusform>%n more characters are not whole either</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Selected: %1 to %2, %n sample(s)</source>
        <translation>
            <numerusform>Selected: %1 to %2, %n sample</numerusform>
            <numerusform>Selected: %1 to %2, %n samples</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n connected</source>
        <translation>
            <numerusform>%n connected</numerusform>
            <numerusform>%n connected</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>posewire::gui::EndedSenders</name>
    <message numerus="yes">
        <source>%n ended senders</source>
        <translation>
            <numerusform>%n ended sender</numerusform>
            <numerusform>%n ended senders</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>posewire::gui::HealthBar</name>
    <message numerus="yes">
        <source>%1 characters</source>
        <translation>
            <numerusform>%1 character</numerusform>
            <numerusform>%1 characters</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>⇉ %n ways out</source>
        <translation>
            <numerusform>⇉ %n way out</numerusform>
            <numerusform>⇉ %n ways out</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>posewire::gui::HelpWindow</name>
    <message numerus="yes">
        <source>%n pages</source>
        <translation>
            <numerusform>%n page</numerusform>
            <numerusform>%n pages</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>posewire::gui::InspectorPanel</name>
    <message numerus="yes">
        <source>%n fields differ</source>
        <translation>
            <numerusform>%n field differs</numerusform>
            <numerusform>%n fields differ</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>posewire::gui::NullPosePanel</name>
    <message numerus="yes">
        <source>%n errors</source>
        <translation>
            <numerusform>%n error</numerusform>
            <numerusform>%n errors</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n warnings</source>
        <translation>
            <numerusform>%n warning</numerusform>
            <numerusform>%n warnings</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>posewire::gui::PlotsPanel</name>
    <message numerus="yes">
        <source>%n curves</source>
        <translation>
            <numerusform>%n curve</numerusform>
            <numerusform>%n curves</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>posewire::gui::StatisticsPanel</name>
    <message numerus="yes">
        <source>%1 · %n streams</source>
        <translation>
            <numerusform>%1 · %n stream</numerusform>
            <numerusform>%1 · %n streams</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>posewire::gui::ViewportOverlay</name>
    <message numerus="yes">
        <source>%n names have no room: come closer</source>
        <translation>
            <numerusform>%n name has no room: come closer</numerusform>
            <numerusform>%n names have no room: come closer</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>posewire::words</name>
    <message numerus="yes">
        <source>{n} samples</source>
        <translation>
            <numerusform>{n} sample</numerusform>
            <numerusform>{n} samples</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} messages</source>
        <translation>
            <numerusform>{n} message</numerusform>
            <numerusform>{n} messages</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} datagrams</source>
        <translation>
            <numerusform>{n} datagram</numerusform>
            <numerusform>{n} datagrams</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} packets</source>
        <translation>
            <numerusform>{n} packet</numerusform>
            <numerusform>{n} packets</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} gaps</source>
        <translation>
            <numerusform>{n} gap</numerusform>
            <numerusform>{n} gaps</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} streams</source>
        <translation>
            <numerusform>{n} stream</numerusform>
            <numerusform>{n} streams</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} characters</source>
        <translation>
            <numerusform>{n} character</numerusform>
            <numerusform>{n} characters</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>types {types}</source>
        <translation>
            <numerusform>type {types}</numerusform>
            <numerusform>types {types}</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{count} are not MXTP[; they look like {looks}].</source>
        <translation>
            <numerusform>{count} is not MXTP[; it looks like {looks}].</numerusform>
            <numerusform>{count} are not MXTP[; they look like {looks}].</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{who}: types {types} are no longer sent while other types of the character still arrive</source>
        <translation>
            <numerusform>{who}: type {types} is no longer sent while other types of the character still arrive</numerusform>
            <numerusform>{who}: types {types} are no longer sent while other types of the character still arrive</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Types {types} are no longer sent while other types of the character still arrive.</source>
        <translation>
            <numerusform>Type {types} is no longer sent while other types of the character still arrive.</numerusform>
            <numerusform>Types {types} are no longer sent while other types of the character still arrive.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>types {types} not sent</source>
        <translation>
            <numerusform>type {types} not sent</numerusform>
            <numerusform>types {types} not sent</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{who} come from several senders at once, {address} and also {others}</source>
        <translation>
            <numerusform>{who} comes from several senders at once, {address} and also {others}</numerusform>
            <numerusform>{who} come from several senders at once, {address} and also {others}</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>TCP loses nothing: {samples} were not sent.</source>
        <translation>
            <numerusform>TCP loses nothing: {samples} was not sent.</numerusform>
            <numerusform>TCP loses nothing: {samples} were not sent.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{who} send no pose[, only {types}]</source>
        <translation>
            <numerusform>{who} sends no pose[, only {types}]</numerusform>
            <numerusform>{who} send no pose[, only {types}]</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} objects</source>
        <translation>
            <numerusform>{n} object</numerusform>
            <numerusform>{n} objects</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} more segments have a name that occurred before</source>
        <translation>
            <numerusform>{n} more segment has a name that occurred before</numerusform>
            <numerusform>{n} more segments have a name that occurred before</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} more segments have a name that occurred before.</source>
        <translation>
            <numerusform>{n} more segment has a name that occurred before.</numerusform>
            <numerusform>{n} more segments have a name that occurred before.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>[Parts {parts}|The last part][ of {all}] of the newest scale message never came; {count} did.</source>
        <translation>
            <numerusform>[Part {parts}|The last part][ of {all}] of the newest scale message never came; {count} did.</numerusform>
            <numerusform>[Parts {parts}|The last part][ of {all}] of the newest scale message never came; {count} did.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} segments and points were left out: the scale message takes more than {limit} KB</source>
        <translation>
            <numerusform>{n} segment or point was left out: the scale message takes more than {limit} KB</numerusform>
            <numerusform>{n} segments and points were left out: the scale message takes more than {limit} KB</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} segments and points were left out: the scale message takes more than {limit} KB.</source>
        <translation>
            <numerusform>{n} segment or point was left out: the scale message takes more than {limit} KB.</numerusform>
            <numerusform>{n} segments and points were left out: the scale message takes more than {limit} KB.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} points on segments that do not exist: {names}; there are {all}</source>
        <translation>
            <numerusform>{n} point on segments that do not exist: {names}; there are {all}</numerusform>
            <numerusform>{n} points on segments that do not exist: {names}; there are {all}</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} points on segments that do not exist: {names}; there are {all}.</source>
        <translation>
            <numerusform>{n} point on segments that do not exist: {names}; there are {all}.</numerusform>
            <numerusform>{n} points on segments that do not exist: {names}; there are {all}.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} earlier scale messages arrived incomplete.</source>
        <translation>
            <numerusform>{n} earlier scale message arrived incomplete.</numerusform>
            <numerusform>{n} earlier scale messages arrived incomplete.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} segment names are not in the specification: {names}.</source>
        <translation>
            <numerusform>{n} segment name is not in the specification: {names}.</numerusform>
            <numerusform>{n} segment names are not in the specification: {names}.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Type 10 has no usable matrix or offset for segments {segments}: a scale must not turn a segment inside out or flatten it.</source>
        <translation>
            <numerusform>Type 10 has no usable matrix or offset for segment {segments}: a scale must not turn a segment inside out or flatten it.</numerusform>
            <numerusform>Type 10 has no usable matrix or offset for segments {segments}: a scale must not turn a segment inside out or flatten it.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} segments below the floor: {names}.</source>
        <translation>
            <numerusform>{n} segment below the floor: {names}.</numerusform>
            <numerusform>{n} segments below the floor: {names}.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} point IDs given twice: {names}.</source>
        <translation>
            <numerusform>{n} point ID given twice: {names}.</numerusform>
            <numerusform>{n} point IDs given twice: {names}.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Points and segments disagree about {n} joints: {names}.</source>
        <translation>
            <numerusform>Points and segments disagree about {n} joint: {names}.</numerusform>
            <numerusform>Points and segments disagree about {n} joints: {names}.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} lengths changed in mid-stream: {names}.</source>
        <translation>
            <numerusform>{n} length changed in mid-stream: {names}.</numerusform>
            <numerusform>{n} lengths changed in mid-stream: {names}.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} segment names are spelled otherwise than in the specification: {names}.</source>
        <translation>
            <numerusform>{n} segment name is spelled otherwise than in the specification: {names}.</numerusform>
            <numerusform>{n} segment names are spelled otherwise than in the specification: {names}.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} points have unfamiliar names: {names}.</source>
        <translation>
            <numerusform>One point has an unfamiliar name: {names}.</numerusform>
            <numerusform>{n} points have unfamiliar names: {names}.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} parts</source>
        <translation>
            <numerusform>{n} part</numerusform>
            <numerusform>{n} parts</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} segments</source>
        <translation>
            <numerusform>{n} segment</numerusform>
            <numerusform>{n} segments</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} props</source>
        <translation>
            <numerusform>{n} prop</numerusform>
            <numerusform>{n} props</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} datagrams have arrived from hosts that are not listened to.</source>
        <translation>
            <numerusform>{n} datagram has arrived from hosts that are not listened to.</numerusform>
            <numerusform>{n} datagrams have arrived from hosts that are not listened to.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} datagrams from {address}[ ({ports} ports)] are not MXTP; the newest begins with {value}[, which looks like {looks}].</source>
        <translation>
            <numerusform>{n} datagram from {address} is not MXTP; it begins with {value}[, which looks like {looks}].</numerusform>
            <numerusform>{n} datagrams from {address}[ ({ports} ports)] are not MXTP; the newest begins with {value}[, which looks like {looks}].</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} datagrams have come to ports of this computer where no program listens.</source>
        <translation>
            <numerusform>{n} datagram has come to a port of this computer where no program listens.</numerusform>
            <numerusform>{n} datagrams have come to ports of this computer where no program listens.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>This computer has refused {n} TCP connections: no program listens at their port.</source>
        <translation>
            <numerusform>This computer has refused {n} TCP connection: no program listens at its port.</numerusform>
            <numerusform>This computer has refused {n} TCP connections: no program listens at their port.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>MXTP behind {n} other bytes (a tunnel, or a length prefix)</source>
        <translation>
            <numerusform>MXTP behind {n} other byte (a tunnel, or a length prefix)</numerusform>
            <numerusform>MXTP behind {n} other bytes (a tunnel, or a length prefix)</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>has {n} MXTP datagrams, but {value} of its {all} bytes belong to none[; it looks like {looks}].</source>
        <translation>
            <numerusform>has {n} MXTP datagram, but {value} of its {all} bytes belong to none[; it looks like {looks}].</numerusform>
            <numerusform>has {n} MXTP datagrams, but {value} of its {all} bytes belong to none[; it looks like {looks}].</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} samples of markers</source>
        <translation>
            <numerusform>{n} sample of markers</numerusform>
            <numerusform>{n} samples of markers</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} are missing: {gaps}</source>
        <translation>
            <numerusform>{n} is missing: {gaps}</numerusform>
            <numerusform>{n} are missing: {gaps}</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>its sender was restarted {n} times[: {pause}]</source>
        <translation>
            <numerusform>its sender was restarted {n} time[: {pause}]</numerusform>
            <numerusform>its sender was restarted {n} times[: {pause}]</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>All {streams} of the sender&apos;s computer were silent for {lasted} ms.</source>
        <translation>
            <numerusform>The only stream of the sender&apos;s computer was silent for {lasted} ms.</numerusform>
            <numerusform>All {streams} of the sender&apos;s computer were silent for {lasted} ms.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{n} finger segments</source>
        <translation>
            <numerusform>{n} finger segment</numerusform>
            <numerusform>{n} finger segments</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>{who} are sent twice, by {address} and also {others}</source>
        <translation>
            <numerusform>{who} is sent twice, by {address} and also {others}</numerusform>
            <numerusform>{who} are sent twice, by {address} and also {others}</numerusform>
        </translation>
    </message>
</context>
</TS>
