// Reads each MCAP file twice, by its index and as a stream with CRCs validated, and prints what it
// found as a line of JSON: the header, the statistics, and every message decoded; or the error.
import { open, readFile } from "node:fs/promises";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { loadDecompressHandlers } from "@mcap/support";

const decompressHandlers = await loadDecompressHandlers();

async function found(path) {
  const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  stream.append(await readFile(path));
  const records = {};
  for (let record; (record = stream.nextRecord()); ) {
    records[record.type] = (records[record.type] ?? 0) + 1;
  }

  const file = await open(path, "r");
  const readable = new FileHandleReadable(file);
  const indexed = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const readers = new Map();
  for (const channel of indexed.channelsById.values()) {
    const schema = indexed.schemasById.get(channel.schemaId);
    const text = new TextDecoder().decode(schema.data);
    readers.set(channel.id, new MessageReader(parse(text, { ros2: true })));
  }
  const messages = [];
  for await (const message of indexed.readMessages()) {
    messages.push({
      topic: indexed.channelsById.get(message.channelId).topic,
      stamp: message.logTime,
      message: readers.get(message.channelId).readMessage(message.data),
    });
  }
  await file.close();
  const { header, statistics } = indexed;
  return { done: stream.done(), records, header, statistics, messages };
}

const plain = (_, value) =>
  typeof value === "bigint" ? String(value) : ArrayBuffer.isView(value) ? [...value] : value;
for (const path of process.argv.slice(2)) {
  const told = await found(path).catch((error) => ({ error: String(error) }));
  console.log(JSON.stringify(told, plain));
}
