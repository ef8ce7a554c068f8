// Reads a server of the Foxglove websocket protocol by Foxglove's own libraries: every topic, decoded.
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");
const WebSocket = require("ws");
const [url, subprotocol, wanted, seconds] = process.argv.slice(2);
const client = new FoxgloveClient({ ws: new WebSocket(url, [subprotocol]) });
const found = {}, readers = {}, errors = [];
client.on("error", (error) => errors.push(String(error)));
client.on("serverInfo", (info) => (found.info = info));
client.on("advertise", (channels) => {
  for (const channel of channels) {
    const reader = new MessageReader(parse(channel.schema, { ros2: true }));
    readers[client.subscribe(channel.id)] = { topic: channel.topic, reader };
    found.topics = (found.topics ?? []).concat(channel.topic);
  }
});
const plain = (key, value) =>
  typeof value === "bigint" ? Number(value) : ArrayBuffer.isView(value) ? Array.from(value) : value;
client.on("message", ({ subscriptionId, timestamp, data }) => {
  const { topic, reader } = readers[subscriptionId];
  const messages = ((found.messages ??= {})[topic] ??= []);
  messages.push({ stamp: String(timestamp), value: reader.readMessage(data) });
  if (messages.length > 400) messages.shift();
  const waiting = wanted.split(",").filter((one) => one && !(found.messages[one] ?? []).length);
  if (!waiting.length && wanted) end();
});
client.on("close", () => end());
let ended = false;
function end() {
  if (ended) return;
  ended = true;
  process.stdout.write(JSON.stringify({ ...found, errors }, plain), () => process.exit(0));
}
setTimeout(end, 1000 * Number(seconds));
