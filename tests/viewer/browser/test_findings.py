# SPDX-License-Identifier: Apache-2.0
"""The findings of the doctor and the marks of the affected frames."""

import pytest
from recordings import START
from runs import SECOND, Run

EVIL = "<img src=x onerror=window.hacked=1>"


def run_with_a_jump():
    run = Run.healthy(skip={"odom", "scan", "static"}, seconds=4)
    for i in range(200):
        run.drive(START + i * SECOND // 50, child=EVIL, offset=3.0 if i > 100 else 0.0)
        run.drive(START + i * SECOND // 50, parent=EVIL, child="base_link")
    return run


@pytest.mark.slow
def test_a_finding_marks_and_selects_its_frame_and_opens_its_page(view, open_page, tmp_path):
    page = open_page(view(run_with_a_jump().write(tmp_path)).url).drawn()
    mark = page.row(EVIL).locator(".mark")
    page.wait(mark.is_visible, "a mark")
    assert mark.get_attribute("data-severity") == "warning"
    assert "TF020 warning" in page.row(EVIL).get_attribute("title")
    assert page.row("base_link").locator(".mark").is_hidden()
    page.tab("findings")
    card = page.raw.locator("#findings .finding[data-code=TF020]")
    text = card.inner_text()
    assert f"odom → {EVIL}" in text
    assert "jumps once" in text
    assert "Why:" in text
    assert "Fix:" in text
    card.locator(".finding-head").click()
    assert page.text("#inspector h2") == EVIL
    card.get_by_text("About TF020").click()
    page.until("document.querySelector('#code-page')?.textContent.includes('Why it matters')")
    page.key("Escape")
    card.locator("[title='Go to the first occurrence']").click()
    page.wait(
        lambda: abs(page.origin() + page.evaluate("coframe.time") - START - 2.02 * SECOND) < 0.05 * SECOND,
        "the seek to the first occurrence",
    )
    assert page.evaluate("window.hacked") is None
