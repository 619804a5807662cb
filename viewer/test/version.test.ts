// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { PROTOCOL_VERSION } from "../src/generated/protocol";
import { compareVersion } from "../src/protocol/version";

function storage(): Pick<Storage, "getItem" | "setItem" | "removeItem"> {
  const values = new Map<string, string>();
  return {
    getItem: (key) => values.get(key) ?? null,
    setItem: (key, value) => void values.set(key, value),
    removeItem: (key) => void values.delete(key),
  };
}

const forbidden = {
  getItem: (): string | null => {
    throw new Error("forbidden");
  },
  setItem: (): void => {
    throw new Error("forbidden");
  },
  removeItem: (): void => {
    throw new Error("forbidden");
  },
};

describe("the protocol version of a page", () => {
  it("is current if it equals the server's", () => {
    expect(compareVersion(PROTOCOL_VERSION, storage())).toBe("current");
    expect(compareVersion(PROTOCOL_VERSION, forbidden)).toBe("current");
  });

  it("causes one reload per server version if it differs", () => {
    const session = storage();
    expect(compareVersion("other", session)).toBe("reload");
    expect(compareVersion("other", session)).toBe("different");
    expect(compareVersion("newer", session)).toBe("reload");
    expect(compareVersion(1, session)).toBe("reload");
    expect(compareVersion(undefined, session)).toBe("reload");
  });

  it("causes a reload again after it matched in between", () => {
    const session = storage();
    expect(compareVersion("other", session)).toBe("reload");
    expect(compareVersion(PROTOCOL_VERSION, session)).toBe("current");
    expect(compareVersion("other", session)).toBe("reload");
  });

  it("never causes a reload without a session storage", () => {
    expect(compareVersion("other", forbidden)).toBe("different");
  });
});
