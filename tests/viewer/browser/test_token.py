# SPDX-License-Identifier: Apache-2.0
"""A viewer for other machines in a browser: the token is in the first address only, and then in a cookie."""

from urllib.parse import urlsplit

import coframe


def test_the_page_works_with_its_token_and_not_without(browser):
    buffer = coframe.Buffer()
    buffer.set("map", "base", coframe.Transform(), static=True)
    with coframe.show(buffer, host="0.0.0.0", port=0) as viewer:
        token = urlsplit(viewer.url).query.removeprefix("token=")
        plain = viewer.url.partition("?")[0]
        context = browser.new_context()
        requested = []
        context.on("request", lambda request: requested.append((request.url, request.headers.get("referer", ""))))
        try:
            page = context.new_page()
            page.goto(plain)
            assert "needs the token" in page.text_content("body")
            page.goto(viewer.url)
            page.wait_for_selector("option[value=base]", state="attached", timeout=20_000)
            assert page.url == plain
            assert token not in page.evaluate("document.cookie + document.documentElement.outerHTML")
            assert [url for url, _ in requested if token in url] == [viewer.url]
            assert not [referrer for _, referrer in requested if token in referrer]
            page.reload()
            page.wait_for_selector("option[value=base]", state="attached", timeout=20_000)
        finally:
            context.close()
