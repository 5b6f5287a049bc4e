// Reads an MCAP file as other people's programs do: with npm's reader, by its index, checksums
// included, and every message by the schema in the file alone.
//
//   node decode.mjs MODULES FILE     a line of JSON per schema, channel, metadata record and message
//
// MODULES is the folder of package.json with node_modules in it. Numbers that JSON has not are
// strings: "NaN", "Infinity", "-Infinity". Fails where a definition differs from the published one.
import assert from "node:assert/strict";
import { open } from "node:fs/promises";
import { createRequire } from "node:module";

const [, , modules, name] = process.argv;
const require = createRequire(`${modules}/package.json`);
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const { ros2humble } = require("@foxglove/rosmsg-msgs-common");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");

const file = await open(name);
const size = (await file.stat()).size;
const readable = {
  size: async () => BigInt(size),
  read: async (offset, length) => {
    const bytes = new Uint8Array(Number(length));
    const { bytesRead } = await file.read(bytes, 0, bytes.length, Number(offset));
    assert.equal(bytesRead, bytes.length);
    return bytes;
  },
};

const told = (key, value) => {
  if (typeof value === "bigint") return Number(value);
  if (typeof value === "number" && !Number.isFinite(value)) return String(value);
  return ArrayBuffer.isView(value) ? [...value].map((v) => told("", v)) : value;
};
const print = (line) => process.stdout.write(JSON.stringify(line, told) + "\n");

// What a published definition is called there; a definition without a name is the schema's own.
const short = (type) => type.replace("/msg/", "/");
function published(definition, ofSchema) {
  const type = short(definition.name ?? ofSchema);
  if (type.startsWith("baraka_msgs/")) return undefined;
  const found = ros2humble[type];
  assert.ok(found, `${type} is not published`);
  return found;
}

// Fields and constants as parsed: names, types, order, lengths, values.
const plain = (fields) =>
  fields.map(({ name, type, isArray, arrayLength, isConstant, value, defaultValue }) => ({
    name, type: short(type), isArray: isArray ?? false, arrayLength, isConstant: isConstant ?? false,
    value, defaultValue,
  }));

const readers = new Map();
const reader = await McapIndexedReader.Initialize({ readable });
for (const schema of reader.schemasById.values()) {
  const text = new TextDecoder().decode(schema.data);
  const definitions = parse(text, { ros2: true });
  let compared = 0;
  for (const definition of definitions) {
    const expected = published(definition, schema.name);
    if (!expected) continue;
    assert.deepEqual(plain(definition.definitions), plain(expected.definitions), schema.name);
    ++compared;
  }
  readers.set(schema.id, new MessageReader(definitions));
  print({ schema: schema.name, encoding: schema.encoding, definitions: definitions.length, compared });
}
for (const channel of reader.channelsById.values()) {
  const { topic, messageEncoding, metadata, schemaId } = channel;
  print({
    channel: topic, messageEncoding, qos: metadata.get("offered_qos_profiles"),
    schema: reader.schemasById.get(schemaId).name,
    counted: reader.statistics.channelMessageCounts.get(channel.id),
  });
}
for await (const { name: record, metadata } of reader.readMetadata()) {
  print({ metadata: record, values: Object.fromEntries(metadata) });
}
let messages = 0n;
for await (const message of reader.readMessages({ validateCrcs: true })) {
  const channel = reader.channelsById.get(message.channelId);
  const decoder = readers.get(channel.schemaId);
  const value = decoder.readMessage(message.data);
  print({ topic: channel.topic, at: message.logTime, sequence: message.sequence, message: value });
  ++messages;
}
assert.equal(messages, reader.statistics.messageCount);

// From the first byte to the last without the index, with the checksums of everything.
const stream = new McapStreamReader({ validateCrcs: true });
const chunk = new Uint8Array(1 << 20);
let inOrder = 0n;
for (;;) {
  const { bytesRead } = await file.read(chunk, 0, chunk.length, null);
  if (bytesRead === 0) break;
  stream.append(chunk.slice(0, bytesRead));
  for (let record; (record = stream.nextRecord()); ) if (record.type === "Message") ++inOrder;
}
assert.ok(stream.done(), "the file does not end as it should");
assert.equal(inOrder, messages);
await file.close();
