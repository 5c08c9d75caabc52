"""The picture as a browser paints it: right pixels; turned, moved, hidden by hand."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from selenium.webdriver import Chrome
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.remote.webelement import WebElement

import screwkit as sk
from screwkit.reports.view_page import view_page

BROWSER = shutil.which("chromium")
DRIVER = shutil.which("chromedriver")
pytestmark = pytest.mark.skipif(
    not (BROWSER and DRIVER), reason="chromium and chromedriver are not installed"
)
BLACK, WHITE = (0, 0, 0), (255, 255, 255)
# Ball joints at the corners of a tetrahedron: no two fall together from any side, and
# bars pass under all of them.  A motor turns `A` about x; nothing drives the others.
PLACES = {"A": (0, 0, 0), "B": (4, 1, 0.5), "C": (1, 3, 1), "D": (2, 1.5, 3)}
TETRAHEDRON = """
screwkit: 1
name: tetrahedron
geometry: posture
base: ground
platform: top
links: [ground, one, two, top]
joints:
  - {name: A, type: spherical, parent: ground, child: one, point: [0, 0, 0],
     actuated: true}
  - {name: B, type: spherical, parent: one, child: two, point: [4, 1, 1/2]}
  - {name: C, type: spherical, parent: two, child: top, point: [1, 3, 1]}
  - {name: D, type: spherical, parent: top, child: ground, point: [2, 3/2, 3]}
"""
VIEWS = {"front": (0, 2), "top": (0, 1), "side": (1, 2)}
NAMES = """
screwkit: 1
name: names
title: "</script><script>document.title='broken'</script>"
geometry: posture
base: "<img src=x onerror=document.title='broken'>"
platform: "</script>"
links: ["<img src=x onerror=document.title='broken'>", "</script>"]
joints:
  - {name: "\\"'><b>", type: revolute, point: [0, 0, 0], axis: [0, 0, 1],
     parent: "<img src=x onerror=document.title='broken'>", child: "</script>"}
"""


@pytest.fixture(scope="module")
def browser() -> Iterator[Chrome]:
    options = Options()
    options.binary_location = str(BROWSER)
    # Containers give little shared memory and no user namespaces; the pages are ours.
    for argument in (
        "headless=new",
        "window-size=900,900",
        "disable-gpu",
        "disable-dev-shm-usage",
        "no-sandbox",
    ):
        options.add_argument(f"--{argument}")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = Chrome(options=options, service=Service(str(DRIVER)))
    yield driver
    driver.quit()


def opened(browser: Chrome, tmp_path: Path, case: sk.Case) -> Page:
    path = tmp_path / "view.html"
    path.write_text(view_page(sk.view(case)), encoding="utf-8")
    page = Page(browser)
    page.complaints()  # what earlier pages left
    browser.get(path.as_uri())
    return page


def written(tmp_path: Path, text: str) -> sk.Case:
    path = tmp_path / "written.yaml"
    path.write_text(text, encoding="utf-8")
    return sk.load(path)


class Page:
    """One open page; places are counted from the middle of the canvas, y upwards."""

    def __init__(self, browser: Chrome) -> None:
        self.browser = browser

    @property
    def canvas(self) -> WebElement:
        return self.browser.find_element(By.ID, "picture")

    def run(self, script: str, *arguments: Any) -> Any:
        return self.browser.execute_script(script, *arguments)

    @property
    def picture(self) -> str:
        return str(self.run("return arguments[0].toDataURL()", self.canvas))

    def pixel(self, x: float, y: float) -> tuple[int, ...]:
        values = self.run(
            "const [c, x, y] = arguments, r = window.devicePixelRatio;"
            "const at = [r * (c.clientWidth / 2 + x), r * (c.clientHeight / 2 - y)];"
            "const d = c.getContext('2d').getImageData(...at.map(Math.round), 1, 1);"
            "return [...d.data]",
            self.canvas,
            x,
            y,
        )
        if not values[3]:  # nothing is painted there, and the page is white
            return WHITE
        ends = {x: end for x in values for end in (0, 255) if abs(x - end) < 8}
        return tuple(ends.get(x, x) for x in values[:3])

    def press(self, selector: str) -> None:
        self.browser.find_element(By.CSS_SELECTOR, selector).click()

    def look(self, view: str) -> None:
        self.press(f"[data-view={view}]")

    def only(self, *groups: str) -> None:
        for box in self.browser.find_elements(By.CSS_SELECTOR, "[data-group]"):
            if box.is_selected() != (box.get_attribute("data-group") in groups):
                box.click()

    def drag(self, dx: int, dy: int, key: str | None = None) -> None:
        hand = ActionChains(self.browser, duration=20)
        if key:
            hand = hand.key_down(key)
        hand = hand.move_to_element(self.canvas).click_and_hold()
        hand = hand.move_by_offset(dx, dy).release()
        if key:
            hand = hand.key_up(key)
        hand.perform()

    def complaints(self) -> list[str]:
        entries = self.browser.execute("getLog", {"type": "browser"})["value"]
        return [entry["message"] for entry in entries]


def places(page: Page, across: int, up: int) -> dict[str, tuple[float, float]]:
    """Where the joints have to be, from the middle and the size that the page tells."""
    middle, size, side = page.run(
        "const s = JSON.parse(document.getElementById('shapes').textContent);"
        "const c = arguments[0];"
        "return [s.middle, s.size, Math.min(c.clientWidth, c.clientHeight)]",
        page.canvas,
    )
    scale = 0.55 * side / size
    return {
        name: (scale * (at[across] - middle[across]), scale * (at[up] - middle[up]))
        for name, at in PLACES.items()
    }


def test_joints_stand_where_the_file_puts_them_seen_from_three_sides(
    browser: Chrome, tmp_path: Path
) -> None:
    page = opened(browser, tmp_path, written(tmp_path, TETRAHEDRON))
    page.only("links", "joints")
    for view, (across, up) in VIEWS.items():
        page.look(view)
        for name, at in places(page, across, up).items():
            assert page.pixel(*at) == (BLACK if name == "A" else WHITE), (view, name)
    page.only("links")  # under the joints there are bars
    page.look("front")
    assert WHITE not in {page.pixel(*at) for at in places(page, 0, 2).values()}


def test_a_hand_turns_moves_and_enlarges_and_the_views_bring_it_back(
    browser: Chrome, tmp_path: Path
) -> None:
    page = opened(browser, tmp_path, written(tmp_path, TETRAHEDRON))
    page.only("links", "joints")
    page.look("front")
    start = page.picture
    page.drag(90, 40)
    assert page.picture != start
    page.look("front")
    assert page.picture == start

    # A quarter turn about the upright axis shows the side.
    page.look("side")
    side = places(page, 1, 2)
    page.look("front")
    for _ in range(4):
        page.drag(-49, 0)
    for name, at in side.items():  # 196 of 196.3 pixels
        assert page.pixel(*at) == (BLACK if name == "A" else WHITE)

    page.look("front")
    page.drag(30, -50, Keys.SHIFT)
    for name, (x, y) in places(page, 0, 2).items():
        assert page.pixel(x + 30, y + 50) == (BLACK if name == "A" else WHITE)


def test_what_is_under_the_pointer_stays_there_when_it_grows(
    browser: Chrome, tmp_path: Path
) -> None:
    page = opened(browser, tmp_path, written(tmp_path, TETRAHEDRON))
    page.only("links", "joints")
    page.look("front")
    at = places(page, 0, 2)
    x, y = map(round, at["A"])
    origin = ScrollOrigin.from_element(page.canvas, x, -y)
    before = page.picture
    ActionChains(browser).scroll_from_origin(origin, 0, -300).perform()
    assert page.picture != before
    assert page.pixel(x, y) == BLACK
    factor = 2.718281828459045**0.45
    for name in "BCD":
        x2, y2 = at[name]
        assert page.pixel(x + factor * (x2 - x), y + factor * (y2 - y)) == WHITE


def test_keys_turn_and_enlarge(browser: Chrome, tmp_path: Path) -> None:
    page = opened(browser, tmp_path, written(tmp_path, TETRAHEDRON))
    page.only("links", "joints")
    page.look("front")
    start, seen = page.picture, set()
    for key, back in (("+", "-"), (Keys.ARROW_LEFT, Keys.ARROW_RIGHT)):
        page.canvas.send_keys(key)
        seen.add(page.picture)
        page.canvas.send_keys(back)
    assert len(seen) == 2
    assert start not in seen


def test_groups_are_hidden_and_shown(browser: Chrome, tmp_path: Path) -> None:
    page = opened(browser, tmp_path, sk.load("3rps"))
    pictures = [page.picture]
    for box in browser.find_elements(By.CSS_SELECTOR, "[data-group]"):
        box.click()
        pictures.append(page.picture)
    assert len(set(pictures)) == len(pictures)


@pytest.mark.parametrize(
    "name", ["nao_t14", "gough_6ups", "five_bar_15", "hand_three_mixed", "lone_body"]
)
def test_pages_are_painted_without_complaint_and_fetch_nothing(
    browser: Chrome, tmp_path: Path, name: str
) -> None:
    page = opened(browser, tmp_path, sk.load(name))
    assert page.complaints() == []
    assert page.run("return performance.getEntriesByType('resource').length") == 0
    blank = "const c = document.createElement('canvas');"
    size = "c.width = arguments[0].width; c.height = arguments[0].height;"
    empty = page.run(blank + size + "return c.toDataURL()", page.canvas)
    assert page.picture != empty


def test_names_of_a_file_are_painted_and_never_run(
    browser: Chrome, tmp_path: Path
) -> None:
    page = opened(browser, tmp_path, written(tmp_path, NAMES))
    assert "broken" not in browser.title.replace("document.title='broken'", "")
    assert page.complaints() == []
    assert browser.find_elements(By.TAG_NAME, "img") == []
    assert browser.find_elements(By.CSS_SELECTOR, "td b") == []
