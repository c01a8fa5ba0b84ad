"""Checks the evidence in this folder. 0: it is consistent. 1: it is not, each line says why. Reads
nothing else, and tells each run again from content/, whose digests the log names."""
import base64, datetime, hashlib, itertools, json, pathlib, sys, tomllib
from types import SimpleNamespace as Values
NOT_CHECKED = ("reception over MQTT", "costs of routes")
class Wrong(Exception): "A reason why the evidence is not believed."
class Story(Values): __getattr__ = lambda s, name: 0  # what has not happened yet
def no(wrong, why="it does not follow from the blueprint and from what stands before"):
	if wrong: raise Wrong(why)
def sha(raw): return hashlib.sha256(raw).hexdigest()
def once(pairs): return no(len(dict(pairs)) < len(pairs), "a key stands twice") or dict(pairs)
def read(raw): return json.loads(raw, object_pairs_hook=once, parse_constant=no)
def escape(name): return name.replace("~", "~0").replace("/", "~1")
def parts(text): return tuple(p.replace("~1", "/").replace("~0", "~") for p in text.split("/"))
def fact(text): a, _, n = text.rpartition("/"); return *parts(a), int(n) if n.isdecimal() else -1
# 1 The blueprint: content/FILE/ has the texts that the digests of a file are made of.
PARTS = ("brought", "behaviour", "meaning", "closure")
def content(texts):
	(brought, own, meaning, closure), hexes = map(read, texts), [*map(sha, texts)]
	theirs, notes, hazards, *more = closure["imported"]
	no([theirs, closure["behaviour"], closure["meaning"]] != hexes[:3], "its texts are of other files")
	notes, bases = dict(notes + meaning[0]), {name: [] for name, _ in own + brought}
	sbs = {name: branch(Values(**said), notes.get(name, {}), bases) for name, said in own + brought}
	for name, n in [(a, n) for a in sbs for n in sbs[a].subs]: bases[sbs[name].subs[n]] += [(name, n)]
	hazards = {one["name"]: [(fact(key), v) for key, v in one["facts"].items()] for one in hazards or
		meaning[1] if type(one) is dict}  # one with a fact that is not there guards nothing
	return dict(hexes=hexes, sbs=sbs, bases=bases, hazards={name: facts for name, facts in
		hazards.items() if all(sb in sbs and -1 < n < sbs[sb].count for (sb, n), _ in facts)},
		levels={key: v for one in (*more, *meaning[2:]) if type(one) is dict for key, v in one.items()},
		runs=sha(texts[1][:-1] + b"," * bool(own and brought) + texts[0][1:]))
def branch(sb, notes, known):  # the names of states hold their facts
	(count, width, opaque), sb.facts, sb.on, sb.goal = sb.facts, {}, 0, sb.activating
	for name in sb.states:
		text = (name[5:].removeprefix("_") if name.startswith("State") else name.rpartition("_")[2] if "_"
			in name else name[-count:]); cut = [text[at:at + width] for at in range(0, len(text), width or
			1)]; sb.facts[name] = [name] if opaque else cut if width else notes["_states"][name]["facts"]
	sb.ops, sb.count = notes.get("_operations", {}), len(sb.facts.get(sb.goal, ()))
	sb.notes = {int(n): note for n, note in notes.get("_facts", {}).items()}
	sb.subs = {int(n): sub for sub, n in sb.sub_sbs if sub in known and int(n) < sb.count}
	sb.on = {n: sb.notes.get(n, {}).get("on", "1" if {at[n] for at in sb.facts.values()} <= {"0", "1"}
		else sb.facts[sb.goal][n]) for n in sb.subs}; return sb  # the value with which a digit is on
def lit(sb, state, n): return sb.facts[state][n] == sb.on[n]
# 2 The log: each line has the SHA-256 of all bytes before it, and the head that of all lines.
def lines(raw):
	(*told, head, end), digest, found = raw.split(b"\n"), hashlib.sha256(), []
	for number, line in enumerate(told, 1):
		digest.update(line[:-66]); no(line[-76:] != b',"chain":"%s"}' % digest.hexdigest().encode(),
			f"line {number}: the chain breaks: this line, or one before it, was changed")
		digest.update(line[-66:] + b"\n"); found.append(read(line[:-76] + b"}"))
	no(end or head != b'{"head":{"count":%d,"hash":"%s"}}' % (len(told) - 1,
		digest.hexdigest().encode()), "it has no head that fits: it was cut, or its run did not end")
	return found[0], found[1:]
# 3 The story: the run is told again, event by event.
CAUSES = dict(resumed="resume", operation_pruned="prune", operation_restored="restore",
	reset="reset", taken_over="take_over", given_back="accept", stopped="stop", disturbed="disturb",
	fault_injected="inject", task_answered="answer")  # what an event needs
def end_step(s): vars(s).update(begun=[], newest={}, pend={}, moved=set(), acting=0, failing=0)
def here(s): return {**s.conf, **s.pend}
def holds(s, key, value, at, way=()):  # whether a fact holds; None: unknown, ...: under way
	(name, n), sb = key, s.sbs[key[0]]
	if key in way: return ...
	if n in sb.subs:  # the fact is the state check of the sub-SB in ACTIVATING
		found = terms(s, {**at, sb.subs[n]: s.sbs[sb.subs[n]].goal}, sb.subs[n], way)
		truth = next((v for v in (False, None, ...) if v in found), True)
		return truth if truth in (None, ...) else truth == (value == sb.on[n])
	believed = sb.facts[at[name]][n] if s.began and key not in s.sensed else None
	return None if s.facts.get(key, believed) is None else s.facts.get(key, believed) == value
def terms(s, at, name, way=()):  # the state check of an SB
	return [holds(s, (name, n), v, at, way) for n, v in enumerate(s.sbs[name].facts[at[name]])]
def all_terms(s, at): return [v for name in at for v in terms(s, at, name)]
def broken(s, at): return [sub for name, sb in s.sbs.items() for n, sub in sb.subs.items() if
	lit(sb, at[name], n) != (at[sub] == s.sbs[sub].goal)]  # sub-SBs that disagree with a base
def placed(s, name, n, state): sub = s.sbs[name].subs[n]; at = s.sbs[sub].goal if lit(s.sbs[name],
	state, n) else s.sbs[sub].initial; return {sub: at, **{k: v for m in s.sbs[sub].subs for k, v in
	placed(s, sub, m, at).items()}}  # where a sub-SB, and all below it, stand at a start
def level(s, *of): return next((a[k] for a in (s.h["levels"], s.levels) for k in of if k in a), "")
def edge(s, address):
	(name, source, word), sb = parts(address), s.sbs[parts(address)[0]]
	own, old, target = escape(word), {**s.conf, name: source}, sb.states[source][word]
	note = {**sb.ops.get(own, {}), **sb.ops.get(f"{escape(source)}/{own}", {})}
	other = any(sb.facts[source][n] != sb.facts[target][n] for n in range(sb.count) if n not in
		sb.subs); turned = {n for n in sb.subs if lit(sb, source, n) != lit(sb, target, n)}
	new, load = {name: target}, note.get("subs") == "load"
	for n in turned if load else (): new = {**placed(s, name, n, target), **new}
	return Values(name=name, source=source, target=target, turned=turned, note=note, places=new, t=s.t,
		needs=load or not turned or other, outcome="", answer="", address=address, level=level(s, address,
		f"{escape(name)}/{own}") or note.get("actor"), done=0, crossed=[n for n in new if (old[n] ==
		s.sbs[n].goal) != (new[n] == s.sbs[n].goal)])
def way(s): return {key for op in s.begun for sub in op.crossed for key in s.bases[sub]}  # digits
def hazards(s, at): return {h for h in s.hazards if all(holds(s, *f, at) for f in s.hazards[h])}
def safe(s, at): no(hazards(s, at) - s.met, "a hazard is met unsaid")
def under_way(s, address): return [op for op in s.begun if op.address == address]
def agrees(s, at): s.facts = {key: v for key, v in s.facts.items() if v or not s.began or key in
	s.sensed}; return at.keys() == s.sbs.keys() and not broken(s, at) and all(all_terms(s, at))
def locate(s, at): s.conf, s.vetoed = {**at}, {e: c for e, c in s.vetoed.items() if c == at}
def take(s, e):
	e, was, kind, c = Values(**e), s.last.event, e["event"], s.cause
	# Time goes on where something takes time, and an effect has its command, at the same time.
	no(s.over or not s.t <= e.t < 2**53 or s.start and kind not in ("left_out", "fact_changed",
		"state_checked") or was == "mismatch" and kind not in ("held", "relocalised", "task_closed") or
		e.t > s.t and s.began and not (s.start or s.begun or s.tasks or s.latch or s.held or s.paused or
		s.by_hand or {*s.goals.values()} & {*s.conf.items()}) or kind in CAUSES and ((c.t, c.command) !=
		(e.t, CAUSES[kind]) or c.by != getattr(e, "by", c.by) or c.address != getattr(e, "address",
		c.address) or c.refused and kind != "task_answered" and "the world is gone" not in c.refused))
	s.t, s.proved, s.checked = e.t, s.checked, s.checked if kind == "state_checked" else {}
	globals()["on_" + kind](s, e); c.t = -1 if kind in CAUSES else c.t
	s.busy, s.last = s.busy if kind in ("fact_changed", "costs_changed", "goal_reached") else e.t, e
def on_run_started(s, e):
	roots = {name: sb.goal for name, sb in s.sbs.items() if not s.bases[name]}
	given, asked = (dict(map(parts, s.h[key])) for key in ("start", "goals"))
	s.goals, s.sensed = {goal: parts(goal) for goal in e.goals}, set(map(fact, e.sensed))
	no(s.began or (e.behaviour, e.world, e.seed) != (s.runs, s.h["world"], s.h["seed"]) or
		dict(s.goals.values()) != (asked or roots) or s.facts and not s.names)
	for name, state in e.start.items():  # bases decide where their sub-SBs stand
		usual = [placed(s, base, n, e.start[base])[name] for base, n in s.bases[name]]
		no(state != s.conf.get(name, given.get(name, (usual or [s.sbs[name].initial])[0])))
	s.conf, s.start, s.began = {**e.start}, {**e.start}, 1
	no(s.conf.keys() != s.sbs.keys() or broken(s, s.conf) or hazards(s, s.conf))
def on_fact_changed(s, e):  # a source or a person tells it
	key, sb = (e.branch, e.digit), s.sbs[e.branch]; human = level(s,
		f"{escape(e.branch)}/{e.digit}") or sb.notes.get(e.digit, {}).get("aggregation"); no(not -1 <
		e.digit < sb.count or s.facts.get(key, 0) == e.value or e.value is not None and (e.digit in
		sb.subs or e.reason or s.began and key not in s.sensed or human == "human" and s.said.get(key) !=
		(s.t, e.value))); s.facts[key] = e.value; s.met = s.met & hazards(s, here(s)) if s.met else s.met
def on_state_checked(s, e):
	(name, state), ops, found = parts(e.address), s.begun, []
	for over in (way(s), ()):  # digits of bases whose sub-SB is on its way; or it commits now
		seen = terms(s, {**here(s), name: state}, name, over); lost = seen.count(False), seen.count(None)
		found.append(("false" if lost[0] else "unknown" if lost[1] else "true", *lost))
	if no((e.result, len(e.misses), len(e.unknown)) not in found) or s.start: return no(([*s.start][0],
		s.start.pop(name), e.result) != (name, state, "true"))
	# An operation leads there now, and a sub-SB that crosses takes an edge of every base along.
	no(not ops or s.acting or s.failing or name in s.checked or not any(op.places.get(name) == state
		for op in ops) or not all(any(op.name == base and n in op.turned for op in ops) for one in ops for
		sub in one.crossed for base, n in s.bases[sub] if base not in {*one.places} - {one.name}))
	s.failing = e.result != "true"
	if not s.failing: safe(s, here(s)); s.checked[name] = s.pend[name] = state
	if name in s.newest and not s.failing: s.newest[name].done |= s.newest[name].target == state
def on_route_planned(s, e): *s.plan, = e.operations; s.chosen = s.asked = no(s.last.event==e.event)
def on_operation_started(s, e):
	a, op, now = e.address, edge(s, e.address), here(s); seen = terms(s, now, op.name, way(s))
	s.chosen, on = s.chosen or s.asked == a, s.plan[:1] == [a]
	# It leaves where its SB stands, on the route or asked for, and nobody has shut it out.
	no(op.target != e.target or now[op.name] != op.source or any((o.outcome == "returned" or o.name ==
		op.name) > o.done for o in s.newest.values()) or s.failing or s.tasks or s.latch or s.acting and
		s.last.event != e.event or a in s.shut or not s.chosen and (not on or s.paused or s.vetoed.get(a)
		== s.conf)); no(False in seen or None in seen and not s.begun); no(not all(holds(s, fact(key),
		value, now) for key, value in op.note.get("requires", {}).items() if fact(key)[0] not in s.moved))
	yes, go = s.said.pop(("confirm", a), 0), s.said.pop(("supervise", a), 0); s.plan = s.plan[on:]
	no(op.needs and bool(e.function) == (op.level == "human") or (op.note.get("confirm") or op.level ==
		"shared") and yes != "confirm" or not (s.begun or s.chosen or s.bases[op.name]) and go != "go_on"
		and level(s, "supervision") == "human"); safe(s, now); s.newest[op.name] = op
	op.function, s.acting, s.held, s.asked = e.function, 1, 0, 0; s.begun = [*s.begun, op]
def on_operation_ended(s, e):  # once, later, or said by a person
	op, how = under_way(s, e.address)[-1], e.outcome; no(op.outcome or s.failing or not (op.function or
		op.answer or how == "cancelled") or how == "returned" and (op.answer not in ("", "done") or e.t <=
		op.t and not op.answer)); op.outcome, s.acting, s.failing = how, 0, how != "returned"
def on_committed(s, e):
	ops, at = [s.begun.pop(s.begun.index(under_way(s, a)[0])) for a in e.operations], s.conf
	for op in ops: at = no(at[op.name] != op.source) or {**at, **op.places}
	# All have ended well and were checked just before; a base commits with its sub-SBs.
	no(not ops or s.acting or s.failing or s.last.t != e.t or any(op.outcome != "returned" *
		bool(op.function or op.answer) for op in ops) or e.configuration != {n: at[n] for op in ops for n
		in op.places} or any(s.proved.get(n) != at[n] or not all(terms(s, {**at, **s.pend}, n, way(s)))
		for n in e.configuration) or broken(s, at))
	locate(s, at); s.moved, s.count = s.moved | {*e.configuration}, s.count + len(ops)
	s.pend = {n: state for n, state in s.pend.items() if state != at[n]}
	s.newest = {n: op for n, op in s.newest.items() if op not in ops}; safe(s, here(s))
	if not (s.begun or any(s.bases[n] or s.sbs[n].subs for op in ops for n in
		op.places)): s.chosen, s.moved = 0, set()
def on_operation_risky(s, e):
	no(s.last.event != e.event and not (s.failing and under_way(s, e.address))); s.begun = []
def on_operation_pruned(s, e): s.shut = {*s.shut, e.address}
def on_operation_restored(s, e): s.shut, s.vetoed = {*s.shut} - {e.address}, {}
def on_mismatch(s, e): no(not [*e.facts]); end_step(s); s.candidates = e.candidates
def on_relocalised(s, e):  # there, adopted, accepted, or one sub
	there, c, was = e.configuration, s.cause, s.last
	moved = [name for name in there if there[name] != s.conf.get(name)]; no(s.acting or was.event ==
		e.event or s.conf and moved and not (was.event == "given_back" and was.configuration == there or
		s.candidates == [there] and (s.h["on_mismatch"] == "adopt" and was.event == "mismatch" or
		(c.command, c.t) == ("adopt", e.t)) or len(moved) == 1 and s.bases[moved[0]]) or not agrees(s,
		there)); locate(s, there); end_step(s); s.held, s.candidates = 0, []
def arrived(s, e): return s.began and not (s.begun or s.held or s.latch or s.busy >= e.t or False in
	all_terms(s, s.conf) or {s.goals[goal] for goal in s.told} - {*s.conf.items()})
def on_goal_reached(s, e): s.told = [*s.told, e.goal]; no([*s.goals][:len(s.told)] != s.told or not
	arrived(s, e) or hazards(s, s.conf) - s.met or not all(terms(s, s.conf, s.goals[e.goal][0])))
def on_hazard_met(s, e): facts = {fact(key): value for key, value in e.facts.items()}; no(facts !=
	dict(s.hazards[e.name]) or e.name not in hazards(s, here(s))); s.met = s.met | {e.name}
def on_held(s, e): end_step(s); s.held, s.paused = e, 0
def on_commanded(s, e):
	no(not e.by); s.cause, word = e, "" if e.refused else e.command
	if word == "veto" and not s.begun: s.vetoed[e.address] = s.conf
	if word in ("resume", "step"): s.paused, s.vetoed = 0, {} if s.held else s.vetoed
	s.asked, s.by_hand = e.address if word == "ask" else s.asked, s.by_hand or "s" in word[:2]
def on_paused(s, e): s.paused, s.held = e.event == "paused", 0
def on_stopped(s, e): end_step(s); vars(s).update(latch=e.event, by=e.by, held=0, asked=0, tasks={})
def on_reset(s, e): s.latch, s.paused = no(not s.latch), e.event == "reset"
def on_task_opened(s, e):  # asks those whom the blueprint names
	kind, (name, n) = e.kind, fact(e.address) if e.kind == "fact" else ("", 0)
	note = {} if kind == "start" else s.sbs[name].notes.get(n, {}) if name else edge(s, e.address).note
	roles = kind != "supervise" and note.get("confirm" if kind == "confirm" else "roles") or [""]
	no(e.task in s.names or e.role != ", ".join(filter(None, roles)) or e.persons != len(roles))
	if kind == "operation": under_way(s, e.address)[-1].answer = "open"
	s.tasks[e.task], s.names = Values(e=e, roles=roles, given={}, also=""), {*s.names, e.task}
def on_task_escalated(s, e): s.tasks[e.task].also = e.role  # another role may answer, too
def same(name): return " ".join(name.casefold().split())
def on_task_answered(s, e):  # another person, in a role
	if no(s.cause.refused != e.refused or s.cause.value not in ("", e.task)) or e.refused: return
	task, given = s.tasks[e.task], [*map(same, s.tasks[e.task].given.values()), same(e.role)]
	no(same(e.by) in map(same, task.given) or e.t >= task.e.deadline or not any(all(not seat or role in
		(seat, same(task.also) or seat) for seat, role in zip(some, given)) for some in
		itertools.permutations(map(same, task.roles), len(given)))); task.given[e.by] = e.role
def on_task_closed(s, e):  # with the answers of all
	task, said = s.tasks.pop(e.task), {*e.answers.values()}
	if no(e.answers and (e.answers.keys() != task.given.keys() or not said <= {*task.e.options}) or
		e.outcome == "answered" and (said != {e.answer} or len(task.given) != task.e.persons) or e.outcome
		== "timed_out" and e.t < task.e.deadline - 1e-5) or e.outcome != "answered": return
	s.said[task.e.kind, task.e.address], s.declined = e.answer, s.declined or task.e.kind == "start"
	if task.e.kind == "fact": s.said[fact(task.e.address)] = (e.t, e.answer)
	for op in under_way(s, task.e.address)[-1:]: op.answer = e.answer
def on_run_finished(s, e):
	held, was, why, s.over = s.held or Values(kind="", reason=""), s.last, e.sentence, 1
	cut = why.startswith(("The window let go", "Stopped in the middle", "Stopped before the run"))
	no(e.operations != s.count or (s.began or s.conf) and e.configuration != s.conf or not why or
		s.tasks and e.reason != "failed" and not cut or was.t != e.t and (was.event == "goal_reached" ==
		e.reason or not (cut or s.h.get("attended", 1)))); no(not {"goal_reached": s.told == [*s.goals]
		and arrived(s, e) and why.split(" hold")[0] == ", ".join(s.goals), "no_route": (held.kind,
		held.reason) == ("no_route", why), "held": held.kind not in ("", "no_route") and held.reason ==
		why or "nobody is there to " in why, "refused": not (s.count or s.begun or s.began and not
		s.declined), "stopped": cut or s.latch == "stopped" and why.startswith(f"Stopped by {s.by}."),
		"failed": was.event == "held" and (was.kind, was.t, was.reason) == ("held", e.t, why)}[e.reason])
on_taken_over, on_given_back, on_resumed = on_stopped, on_reset, on_paused
for w in "left_out subs_bypassed operation_refused disturbed fault_injected costs_changed".split():
	globals()["on_" + w] = lambda s, e: 0  # nothing follows from these
def tell(contents, raw, files=()):
	header, events = lines(raw); header["met"] = [v for e in events for v in e.get("met", ())]
	said = header["digests"]; known = [c for c in contents if c["hexes"][1:] == [said[n] for n in
		PARTS[1:]]]; no((header["log"], header["version"]) != ("smsl-run", 3) or not known or files and
		not {said["file"], *said.get("imported", {}).values()} <= files, "its blueprint is not here")
	s = Story(**known[0], h=header, last=Values(event="", t=0), conf={}, facts={}, said={}, tasks={},
		goals={}, met=set(), told=[], cause=Values(t=-1), busy=-1, vetoed={}, names=(), t=0, checked={},
		plan=[], shut=header["avoid"], candidates=[], by_hand=header["by_hand"]); end_step(s)
	for number, event in enumerate(events, 2):
		try: take(s, event)
		except Exception as error: raise Wrong(f"line {number}: {event.get('event')}: {error}") from None
	return no(not s.over, "the log ends, and its run does not") or header
# 4 The records: who has signed, and whether the policy asks for more.
def when(at): return datetime.datetime.fromisoformat(at + "T23:59:59+00:00" * ("T" not in at))
def opened(envelope, public, kind):  # what this key has signed
	from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey as Key
	body, (one,) = base64.b64decode(envelope["payload"]), envelope["signatures"]
	kind = f"application/vnd.{kind}+json"; no(envelope["payloadType"] != kind, "signed otherwise")
	Key.from_public_bytes(public).verify(base64.b64decode(one["sig"]), b"DSSEv1 %d %b %d %b" % (
		len(kind), kind.encode(), len(body), body)); return body
def judge(files, known, log):
	load = lambda name: b"".join(one.read_bytes() for one in files(name))
	policy = tomllib.loads(load("policy.toml").decode()); own = policy.get("register_key")
	persons = read(opened(read(load("register.json")), base64.b64decode(own), "smsl-studio.register")
		if own else load("keys.json"))["persons"]; void, last, before = {*policy.get("revoked",
		())}, {}, when("1999-01-01"); keys = {"sha256:" + sha(key): {**one, "key": key} for one in persons
		for key in map(base64.b64decode, one["keys"])}
	for envelope in [one for path in files("records/*") for one in read(path.read_bytes())["records"]]:
		one = keys[envelope["signatures"][0]["keyid"]]  # the last word of each person counts
		body = opened(envelope, one["key"], "in-toto"); said, sums = read(body)["predicate"], read(
			body)["subject"][0]["digest"]; at = when(said["time"]); day = when(log.get("wall_time",
			said["time"])); no(at <= before, "out of order"); late = at > day + datetime.timedelta(minutes=5)
		who = "" if late else same(one["person"]); old = last.get(who, [{"met": [], "conditions": []}])[0]
		said["conditions"] += old["conditions"] * bool(said["met"]); said["met"] += old["met"]
		last[who], before = (said, {*map(same, one["roles"])}, day <= min(at + datetime.timedelta(
			policy.get("valid_days", 1e5)), when(said["expires"] or "9999-12-30")) and at <= when(
			one.get("until") or "9999-12-30") and [sums[n] for n in PARTS[1:]] in [c["hexes"][1:] for c in
			known] and sums.items() <= log.get("digests", sums).items() and not one.get("revoked") and not
			void & {*map("sha256:".__add__, [*sums.values(), sha(one["key"])]), "record:sha256:" + sha(body)
			}), at
	last.pop("", 0); no(any(said["verdict"] == "rejected" for said, *_ in last.values()), "rejected")
	good = [(said, roles) for said, roles, fine in last.values() if fine and "automatic" not in roles]
	seats = [same(role) for role, n in policy.get("roles", {}).items() for _ in range(min(n, 99))]
	no(len(good) < policy.get("persons", len(seats) or 1) or not any(all(seat in roles for seat, (_,
		roles) in zip(seats, some)) for some in itertools.permutations(good, len(seats))), "too few sign")
	for text, roles in [(text, roles) for said, roles in good for text in said["conditions"]]:
		no(text not in log.get("met", ()) and not any(text in other["met"] and roles & theirs for other,
			theirs in good), "a condition is open: " + text)
# 5 The folder: everything in it is checked, and nothing else.
def main():
	wrong, known, root = [], [], pathlib.Path("."); files = lambda way: sorted(root.glob(way))
	def tried(place, act):
		try: return act()
		except Exception as error: wrong.append(f"{place}: {str(error) or repr(error)}")
	for path in files("content/**/closure.json"): known += filter(None, [tried(path, lambda:
		content([(path.parent / f"{part}.json").read_bytes() for part in PARTS]))])
	hexes = {None, *(tried(one, lambda: sha(one.read_bytes())) for one in files("blueprint/**/*.*"))}
	logs = [tried(one, lambda: tell(known, one.read_bytes(), hexes)) or {} for one in files("logs/*")]
	signed = files("records/*") or files("policy.toml")
	for log in (logs or [{}]) if signed else (): tried("records", lambda: judge(files, known, log))
	said = ["No log: nothing is said about a run."] * (not logs) + [f"Not checked: {one}." for one in
		NOT_CHECKED] + ["No record: nobody has approved this blueprint."] * (not signed) + wrong
	for line in [*said, "Not consistent." if wrong else "Consistent."]:
		print(" ".join(line.split()).encode("ascii", "backslashreplace").decode()[:500])
	return bool(wrong)
if __name__ == "__main__": sys.exit(main())
