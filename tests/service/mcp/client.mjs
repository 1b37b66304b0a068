// The server beside the protocol's own client library: node client.mjs PROGRAM DATA
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { Client } from "@modelcontextprotocol/sdk/client/index.js";
import { StdioClientTransport } from "@modelcontextprotocol/sdk/client/stdio.js";

const [program, data] = process.argv.slice(2);
const client = new Client({ name: "turnwright-test", version: "1" });
await client.connect(
  new StdioClientTransport({ command: program, args: ["mcp", "--data", data] }));
assert.equal(client.getServerVersion().name, "turnwright");

const { tools } = await client.listTools();
for (const name of ["plan", "stability", "import"])
  assert.ok(tools.some((tool) => tool.name === name), name);

// Every tool answers its own example.
for (const tool of tools) {
  const answer = await client.callTool(
    { name: tool.name, arguments: tool.inputSchema.examples[0] });
  assert.equal(answer.isError, false, `${tool.name}: ${answer.content[0].text}`);
  assert.equal(answer.structuredContent.format, `turnwright-${tool.name}-result/1`);
}

const { resources } = await client.listResources();
for (const resource of resources) {
  const { contents } = await client.readResource({ uri: resource.uri });
  JSON.parse(contents[0].text);
}
const pump = await client.readResource({ uri: "turnwright://parts/pump-shaft" });
const part = JSON.parse(readFileSync(`${data}/parts/pump-shaft.json`, "utf8"));
assert.deepEqual(JSON.parse(pump.contents[0].text), part);

const wrong = await client.callTool({ name: "plan", arguments: { ...part, batch: -1 } });
assert.ok(wrong.isError);
assert.match(wrong.content[0].text, /\/batch/);
await assert.rejects(client.callTool({ name: "nothing", arguments: {} }), { code: -32602 });
await assert.rejects(client.readResource({ uri: "turnwright://parts/none" }),
                     { code: -32002 });
await client.close();
console.log(`${tools.length} tools, ${resources.length} resources`);
