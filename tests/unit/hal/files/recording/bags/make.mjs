// Writes the MCAP files beside it with npm's writer (@mcap/core); chunks are compressed by the programs zstd and lz4.
//
//   node make.mjs MODULES     the folder of tests/e2e/mcap/package.json with node_modules in it
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";

const require = createRequire(`${process.argv[2]}/package.json`);
const { McapWriter, TempBuffer } = require("@mcap/core");
const here = dirname(fileURLToPath(import.meta.url));
const text = (s) => new TextEncoder().encode(s);

const qos = (history, depth, reliability, durability, sec, nsec) =>
  `- history: ${history}\n  depth: ${depth}\n  reliability: ${reliability}\n  durability: ${durability}\n` +
  `  deadline:\n    sec: ${sec}\n    nsec: ${nsec}\n  lifespan:\n    sec: 0\n    nsec: 0\n  liveliness: 1\n` +
  `  liveliness_lease_duration:\n    sec: 0\n    nsec: 0\n  avoid_ros_namespace_conventions: false`;
const SCAN = qos(3, 0, 2, 2, 2147483647, 4294967295); // as Humble records it
const ODOM = qos("keep_last", 5, "reliable", "volatile", 0, 50000000); // as Iron and later do
const STATIC = qos(2, 0, 1, 1, 0, 0);

const START = 1700000000000000000n;
const programs = { zstd: ["zstd", "-q", "-c", "-19"], lz4: ["lz4", "-q", "-c", "-9"] };
const compress = (compression) => (data) => {
  const [program, ...options] = programs[compression] ?? [];
  if (!program) return { compression, compressedData: data };
  return { compression, compressedData: new Uint8Array(execFileSync(program, options, { input: data })) };
};

async function write(name, options, { profile = "ros2", encoding = "cdr", type = "ros2msg", small = false } = {}) {
  const buffer = new TempBuffer();
  const writer = new McapWriter({ writable: buffer, ...options });
  await writer.start({ profile, library: "@mcap/core" });
  const channels = [];
  const channel = async (topic, schema, profiles) => {
    const schemaId = await writer.registerSchema({ name: schema, encoding: type, data: text("# left out") });
    const metadata = new Map(profiles ? [["offered_qos_profiles", profiles]] : []);
    channels.push(await writer.registerChannel({ schemaId, topic, messageEncoding: encoding, metadata }));
  };
  await channel("/scan", "sensor_msgs/msg/LaserScan", SCAN);
  await channel("/odom", "nav_msgs/msg/Odometry", ODOM);
  if (!small) await channel("/tf_static", "tf2_msgs/msg/TFMessage", STATIC);
  const add = (index, sequence, ms, publishedMs, size) =>
    writer.addMessage({
      channelId: channels[index], sequence, logTime: START + BigInt(ms) * 1000000n,
      publishTime: publishedMs === undefined ? 0n : START + BigInt(publishedMs) * 1000000n,
      data: new Uint8Array(size).fill(7, 4),
    });
  if (!small) await add(2, 0, 0, undefined, 104);
  for (let i = 0; i < (small ? 2 : 10); ++i) {
    await add(0, i, 100 * i + 10, 100 * i + 8, 400 + i); // 2 ms under way
    await add(1, i, 100 * i + 20, undefined, 80);
  }
  await writer.end();
  writeFileSync(`${here}/${name}`, buffer.get());
}

await write("zstd.mcap", { chunkSize: 1500, compressChunk: compress("zstd") });
await write("lz4.mcap", { chunkSize: 1500, compressChunk: compress("lz4") });
await write("chunks.mcap", { chunkSize: 1500 });
await write("small.mcap", { compressChunk: compress("zstd") }, { small: true });
await write("plain.mcap", { useChunks: false });
await write("no_summary.mcap", {
  useStatistics: false, useSummaryOffsets: false, useMessageIndex: false, useChunkIndex: false,
  useChunks: false, repeatSchemas: false, repeatChannels: false,
});
await write("brotli.mcap", { chunkSize: 1500, compressChunk: compress("brotli") });
await write("json.mcap", { useChunks: false }, { profile: "", encoding: "json", type: "jsonschema" });
