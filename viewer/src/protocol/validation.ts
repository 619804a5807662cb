// SPDX-License-Identifier: Apache-2.0
/** Checks JSON values against the generated schema of the protocol. */

import { RECORDS, SERVER_MESSAGES, type Schema, type ServerMessage } from "../generated/protocol";

export class ProtocolError extends Error {}

/** Returns a server's message, or throws a ProtocolError that names the invalid field. */
export function checkServerMessage(value: unknown): ServerMessage {
  const type = isObject(value) && typeof value.type === "string" ? value.type : null;
  if (type === null) throw new ProtocolError("a message without a type");
  const record = Object.hasOwn(SERVER_MESSAGES, type) ? SERVER_MESSAGES[type] : undefined;
  if (record === undefined) throw new ProtocolError(`a message of unknown type ${type.slice(0, 40)}`);
  check(value, `@${record}`, type);
  return value as unknown as ServerMessage;
}

function check(value: unknown, schema: Schema, path: string): void {
  if (typeof schema === "string") {
    if (schema.startsWith("@")) checkRecord(value, schema.slice(1), path);
    else if (schema === "j") expect(isObject(value), path, "an object");
    else expect(typeof value === PLAIN[schema], path, `a ${PLAIN[schema] ?? schema}`);
    return;
  }
  switch (schema[0]) {
    case "?":
      if (value !== null) check(value, schema[1], path);
      break;
    case "a":
      expect(Array.isArray(value), path, "an array");
      (value as unknown[]).forEach((item, i) => check(item, schema[1], `${path}[${i}]`));
      break;
    case "m":
      expect(isObject(value), path, "an object");
      for (const [key, item] of Object.entries(value as object)) check(item, schema[1], `${path}.${key.slice(0, 40)}`);
      break;
    case "t": {
      const items = schema.slice(1) as Schema[];
      expect(Array.isArray(value) && value.length === items.length, path, `an array of ${items.length}`);
      items.forEach((item, i) => check((value as unknown[])[i], item, `${path}[${i}]`));
      break;
    }
    case "l":
      expect(schema.indexOf(value as string, 1) > 0, path, schema.slice(1).join(" or "));
      break;
  }
}

function checkRecord(value: unknown, name: string, path: string): void {
  expect(isObject(value), path, "an object");
  for (const [field, schema] of Object.entries(RECORDS[name] ?? {})) {
    const optional = field.endsWith("?");
    const key = optional ? field.slice(0, -1) : field;
    const part = (value as Record<string, unknown>)[key];
    if (!(optional && part === undefined)) check(part, schema, `${path}.${key}`);
  }
}

const PLAIN: Readonly<Record<string, string>> = { s: "string", b: "boolean", n: "number" };

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function expect(valid: boolean, path: string, expected: string): void {
  if (!valid) throw new ProtocolError(`${path} must be ${expected}`);
}
