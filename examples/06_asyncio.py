# SPDX-License-Identifier: Apache-2.0
"""Wait for transforms in an asyncio program: other tasks run in the meantime, and nothing polls."""

from __future__ import annotations

import asyncio

import coframe

SECOND = 1_000_000_000


async def publish(buffer: coframe.Buffer) -> None:
    """Insert one transform every 20 ms, as a subscription would do in a dedicated thread."""
    for step in range(1, 6):
        await asyncio.sleep(0.02)
        buffer.set("odom", "base_link", coframe.Transform([0.1 * step, 0.0, 0.0]), step * SECOND)


async def main() -> None:
    buffer = coframe.Buffer()
    publisher = asyncio.create_task(publish(buffer))
    # Both stamps lie in the future of the buffer; each call returns as soon as its own transform can be computed.
    first, last = await asyncio.gather(
        buffer.wait_async("odom", "base_link", 2 * SECOND + SECOND // 2, timeout="5s"),
        buffer.wait_async("odom", "base_link", 5 * SECOND, timeout="5s"),
    )
    print(f"at 2.5 s: x = {first.translation[0]:.2f} m; at 5 s: x = {last.translation[0]:.2f} m")
    await publisher

    try:
        await buffer.wait_async("odom", "base_link", 9 * SECOND, timeout="50ms")
    except coframe.TimeoutException as error:
        print(f"no transform: {error}")


if __name__ == "__main__":
    asyncio.run(main())
