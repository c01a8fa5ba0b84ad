"""Checks the evidence in this folder. 0: it is consistent. 1: it is not, each line says why.
Each run is told again from content/, whose digests the log names."""
import base64, datetime, hashlib, itertools, json, pathlib, sys, tomllib, types
NOT_CHECKED = "reception over MQTT", "routes", "words that move nothing", "code", "imported records"
class Wrong(Exception): "A reason why the evidence is not believed."
class Story(types.SimpleNamespace): __getattr__ = lambda s, name: 0  # what has not happened yet
def no(wrong, why="it does not follow from the blueprint and from what stands before"):
	if wrong: raise Wrong(why)
def sha(raw): return hashlib.sha256(raw).hexdigest()
def once(pairs): return no(len(dict(pairs)) < len(pairs), "a key stands twice") or dict(pairs)
def read(raw): return json.loads(raw.decode(), object_pairs_hook=once, parse_constant=no)
def plain(value): return json.dumps(value, separators=(",", ":")).encode()
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
	sbs = {name: branch(Story(**said), notes.get(name, {}), bases) for name, said in own + brought}
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
	said = read(head) | {"head": {"count": len(told) - 1, "hash": digest.hexdigest()}}; no(end or head
		!= plain(said) or [*said][1:] != ["signed"] * bool(said.get("signed")), "its head does not fit")
	return found[0] | {"head": plain(said["head"]), "signed": said.get("signed")}, found[1:]
# 3 The story: the run is told again, event by event.
CAUSES = dict(resumed="resume", operation_pruned="prune", operation_restored="restore",
	reset="reset", taken_over="take_over", given_back="accept", stopped="stop", disturbed="disturb",
	fault_injected="inject", task_answered="answer")  # what an event needs
def end_step(s): vars(s).update(begun=[], moved=set(), acting=0, failing=0)
def here(s): return s.conf | {n: at for op in s.begun if op.done for n, at in op.new.items()}
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
def placed(s, name, n, state): name, on = s.sbs[name].subs[n], lit(s.sbs[name], state,
	n); sb = s.sbs[name]; at = sb.goal if on else sb.initial; return {name: at} | {k: v for m in
	sb.subs for k, v in placed(s, name, m, at).items()}
def level(s, *of): return next((a[k] for a in (s.h["levels"], s.levels) for k in of if k in a), "")
def edge(s, address):
	name, source, word = parts(address); sb, own = s.sbs[name], escape(word); note = sb.ops.get(own,
		{}) | sb.ops.get(f"{escape(source)}/{own}", {}); was = s.conf | {name: source}
	target, load = sb.states[source][word], note.get("subs") == "load"; new = {name: target}
	diff = {n for n in range(sb.count) if sb.facts[source][n] != sb.facts[target][n]}
	for n in diff & {*sb.subs} if load else (): new = placed(s, name, n, target) | new
	return Story(name=name, source=source, target=target, note=note, new=new, t=s.t, address=address,
		needs=load or not diff or diff - {*sb.subs}, level=level(s, address, f"{escape(name)}/{own}") or
		note.get("actor"), along=[(name, n) for n in diff] + [(b, n) for b in new if b != name for n in
		s.sbs[b].subs], crossed=[n for n in new if s.sbs[n].goal in {was[n]} ^ {new[n]}])
def way(s): return {key for op in s.begun for sub in op.crossed for key in s.bases[sub]}  # digits
def hazards(s, at): return {h for h in s.hazards if all(holds(s, *f, at) for f in s.hazards[h])}
def safe(s, at): no(hazards(s, at) - s.met, "a hazard is met unsaid")
def under_way(s, address): return [op for op in s.begun if op.address == address]
def agrees(s, at): s.facts = {key: v for key, v in s.facts.items() if v or not s.began or key in
	s.sensed}; return at.keys() == s.sbs.keys() and not broken(s, at) and all(all_terms(s, at))
def locate(s, at): s.conf, s.vetoed = at, s.vetoed if at == s.conf else ()
def take(s, e):
	# Time goes on where something takes time, and an effect has its command, at the same time.
	e, kind, c = types.SimpleNamespace(**e), e["event"], s.cause; no(s.over or not s.t <= e.t < 2**53
		or s.start and kind not in ("left_out", "fact_changed", "state_checked") or e.t > s.t and s.began
		and not (s.start or s.begun or s.tasks or s.latch or s.held or s.paused or s.by_hand or
		{*s.goals.values()} & {*s.conf.items()}) or kind in CAUSES and ((c.t, c.command) != (e.t,
		CAUSES[kind]) or c.by != getattr(e, "by", c.by) or c.address != getattr(e, "address", c.address)
		or c.refused and kind != "task_answered" and "the world is gone" not in c.refused))
	s.t = e.t; globals()["on_" + kind](s, e); c.t = -1 if kind in CAUSES else c.t
	s.checked = s.checked if kind == "state_checked" else {}
	s.busy, s.last = s.busy if kind in ("fact_changed", "costs_changed", "goal_reached") else e.t, e
def on_run_started(s, e):
	roots = {name: sb.goal for name, sb in s.sbs.items() if not s.bases[name]}
	given, asked = (dict(map(parts, s.h[key])) for key in ("start", "goals"))
	s.goals, s.sensed = {goal: parts(goal) for goal in e.goals}, set(map(fact, e.sensed))
	no(s.began or (e.behaviour, e.world, e.seed) != (s.runs, s.h["world"], s.h["seed"]) or
		dict(s.goals.values()) != (asked or roots) or s.facts and not s.names)
	for name, state in e.start.items():  # bases decide where their sub-SBs stand
		sb = s.sbs[name]; usual = state if s.bases[name] and state == sb.activating else sb.initial
		no(state != s.conf.get(name, given.get(name, usual)))
	s.conf, s.start, s.began = {**e.start}, {**e.start}, 1
	no(s.conf.keys() != s.sbs.keys() or broken(s, s.conf) or hazards(s, s.conf))
def on_fact_changed(s, e):  # a source or a person tells it
	key, sb, name = (e.branch, e.digit), s.sbs[e.branch], f"{escape(e.branch)}/{e.digit}"
	human = level(s, name) or sb.notes.get(e.digit, {}).get("aggregation"); no(not -1 < e.digit <
		sb.count or s.facts.get(key, 0) == e.value or e.value is not None and (e.digit in sb.subs or
		e.reason or s.began and key not in s.sensed or human == "human" and s.said.get(("fact", name)) !=
		(e.t, e.value))); s.facts[key] = e.value; s.met = s.met and s.met & hazards(s, here(s))
def on_state_checked(s, e):
	name, state = parts(e.address); seen = terms(s, here(s) | {name: state}, name, way(s))
	no((len(e.misses), len(e.unknown), e.result) != (seen.count(False), seen.count(None), "false" if
		e.misses else "unknown" if e.unknown else "true"))
	if s.start: return no(([*s.start][0], s.start.pop(name), e.result) != (name, state, "true"))
	# An operation leads there now, and a sub-SB that crosses takes an edge of every base along.
	no(s.acting or s.failing or name in s.checked or not any(op.new.get(name) == state for op in
		s.begun) or way(s) - {key for op in s.begun for key in op.along}); s.failing = e.result != "true"
	if not s.failing: safe(s, here(s)); s.checked[name] = state
	for op in s.begun if not s.failing else (): op.done |= op.name == name and op.target == state
def on_route_planned(s, e): *s.plan, = e.operations; s.chosen = s.asked = no(s.last.event==e.event)
def on_operation_started(s, e):
	a, op, now = e.address, edge(s, e.address), here(s); seen = terms(s, now, op.name, way(s))
	s.chosen, on = s.chosen or s.asked == a, s.plan[:1] == [a]
	# It leaves where its SB stands, on the route or asked for, and nobody has shut it out.
	no(op.target != e.target or now[op.name] != op.source or any((o.outcome == "returned" or o.name ==
		op.name) > o.done for o in s.begun) or s.failing or s.tasks or s.latch or s.acting and
		s.last.event != e.event or a in s.shut or not s.chosen and (not on or s.paused or a in
		s.vetoed)); no(False in seen or None in seen and not s.begun); no(not all(holds(s, fact(key),
		value, now) for key, value in op.note.get("requires", {}).items() if fact(key)[0] not in s.moved))
	yes, go = (s.said.pop((k, a), "  ")[1] for k in ("confirm", "supervise")); s.plan = s.plan[on:]
	no(op.needs and bool(e.function) == (op.level == "human") or (op.note.get("confirm") or op.level ==
		"shared") and yes != "confirm" or not (s.begun or s.chosen or s.bases[op.name]) and go != "go_on"
		and level(s, "supervision") == "human"); safe(s, now)
	op.function, s.acting, s.held, s.asked = e.function, 1, 0, 0; s.begun = [*s.begun, op]
def on_operation_ended(s, e):  # once, later, or said by a person
	op, how = under_way(s, e.address)[-1], e.outcome; no(op.outcome or s.failing or not (op.function or
		op.answer or how == "cancelled") or how == "returned" and (op.answer not in (0, "done") or e.t <=
		op.t and not op.answer)); op.outcome, s.acting, s.failing = how, 0, how != "returned"
def on_committed(s, e):
	new, ops = e.configuration, [s.begun.pop(s.begun.index(under_way(s, a)[0])) for a in e.operations]
	at = s.conf | {n: state for op in ops for n, state in op.new.items()}
	# All have ended well and were checked just before; a base commits with its sub-SBs.
	no(not ops or s.acting or s.failing or s.last.t != e.t or any(op.outcome != ("returned" if
		op.function or op.answer else 0) for op in ops) or new != {n: at[n] for op in ops for n in op.new}
		or any(s.checked.get(n) != at[n] for n in new) or broken(s, at))
	locate(s, at); safe(s, here(s)); s.moved, s.count = s.moved | {*new}, s.count + len(ops)
	if not (s.begun or any(s.bases[n] or s.sbs[n].subs for n in new)): s.chosen, s.moved = 0, set()
def on_operation_risky(s, e):
	no(s.last.event != e.event and not (s.failing and under_way(s, e.address))); s.begun = []
def on_operation_pruned(s, e): s.shut = {*s.shut, e.address}
def on_operation_restored(s, e): s.shut, s.vetoed = {*s.shut} - {e.address}, ()
def on_mismatch(s, e): no(not e.facts or type(e.facts) is dict); end_step(s); s.only = e.candidates
def on_relocalised(s, e):  # there, adopted, accepted, or one sub
	there, c, was = e.configuration, s.cause, s.last; moved = [name for name in there if there[name] !=
		s.conf.get(name)]; no(s.acting or was.event == e.event or s.conf and moved and not (was.event ==
		"given_back" and was.configuration == there or s.only == [there] and (s.h["on_mismatch"] ==
		"adopt" and was.event == "mismatch" or (c.command, c.t) == ("adopt", e.t)) or len(moved) == 1 and
		s.bases[moved[0]]) or not agrees(s, there)); locate(s, there); end_step(s); s.held, s.only = 0, 0
def arrived(s, e): return s.began and not (s.begun or s.held or s.latch or s.busy >= e.t or False in
	all_terms(s, s.conf) or {s.goals[goal] for goal in s.told} - {*s.conf.items()})
def on_goal_reached(s, e): s.told = [*s.told, e.goal]; no([*s.goals][:len(s.told)] != s.told or not
	arrived(s, e) or hazards(s, s.conf) - s.met or not all(terms(s, s.conf, s.goals[e.goal][0])))
def on_hazard_met(s, e): facts = {fact(key): value for key, value in e.facts.items()}; no(facts !=
	dict(s.hazards[e.name]) or e.name not in hazards(s, here(s))); s.met = s.met | {e.name}
def on_held(s, e): end_step(s); s.held, s.paused = (e.kind, e.reason), 0
def on_commanded(s, e):
	no(not e.by or e.value is None); s.cause, word = e, "" if e.refused else e.command
	if word in ("resume", "step"): s.paused, s.vetoed = 0, () if s.held else s.vetoed
	s.vetoed = (*s.vetoed, e.address) if word == "veto" and not s.begun else s.vetoed
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
	s.tasks[e.task], s.names = Story(e=e, roles=roles, given={}, also=""), {*s.names, e.task}
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
	s.said[task.e.kind, task.e.address] = e.t, e.answer
	for op in under_way(s, task.e.address)[-1:]: op.answer = e.answer
def on_run_finished(s, e):
	(kind, held), was, why, s.over = s.held or ("", ""), s.last, e.sentence, 1
	cut = why.startswith(("The window let go", "Stopped in the middle", "Stopped before the run"))
	no(e.operations != s.count or (s.began or s.conf) and e.configuration != s.conf or not why or
		s.tasks and e.reason != "failed" and not cut or was.t != e.t and (was.event == "goal_reached" ==
		e.reason or not (cut or s.h.get("attended", 1)))); no(not {"goal_reached": s.told == [*s.goals]
		and arrived(s, e) and why.split(" hold")[0] == ", ".join(s.goals), "no_route": (kind, held) ==
		(e.reason, why), "held": kind != "no_route" and held == why or "nobody is there to " in why,
		"refused": not (s.count or s.begun or s.began and ("start", "") not in s.said), "stopped": cut or
		s.latch == "stopped" and why.startswith(f"Stopped by {s.by}."), "failed": was.event == kind ==
		"held" and (was.t, held) == (e.t, why)}[e.reason])
on_taken_over, on_given_back, on_resumed = on_stopped, on_reset, on_paused
for w in "left_out subs_bypassed operation_refused disturbed fault_injected costs_changed".split():
	globals()["on_" + w] = lambda s, e: 0  # nothing follows from these
def tell(contents, raw, files=()):
	h, events = lines(raw); h["met"] = [v for e in events for v in e.get("met", ())]
	said = h["digests"]; known = [c for c in contents if c["hexes"][1:] == [said[n] for n in
		PARTS[1:]]]; no((h["log"], h["version"]) != ("smsl-run", 3) or not known or files and not
		{said["file"], *said.get("imported", {}).values()} <= files, "its blueprint is not here")
	s = Story(**known[0], h=h, last=Story(), conf={}, facts={}, said={}, tasks={}, goals={}, met=set(),
		told=[], cause=Story(t=-1), busy=-1, vetoed=(), names=(), t=0, checked={}, plan=[],
		shut=h["avoid"], by_hand=h["by_hand"]); end_step(s)
	for number, event in enumerate(events, 2):
		try: take(s, event)
		except Exception as error: raise Wrong(f"line {number}: {event.get('event')}: {error}") from None
	return no(not s.over, "the log ends, and its run does not") or h
# 4 The records: who has signed (DSSE, Ed25519), and whether the policy asks for more.
def when(at): return datetime.datetime.fromisoformat(at + "T23:59:59Z" * ("T" not in at))
def trusted(load):  # the policy, and whose keys count
	policy = tomllib.loads(load("policy.toml").decode())
	own = base64.b64decode(policy.get("register_key", "")); keys = {"sha256:" + sha(own): {"key": own}}
	persons = read(opened(read(load("register.json")), keys, "smsl-studio.register")[0] if own else
		load("keys.json"))["persons"]; return policy, {"sha256:" + sha(key): {**one, "key": key} for one
		in persons for key in map(base64.b64decode, one["keys"])}
def opened(envelope, keys, kind):  # what is signed, and by whom
	from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey as Key
	(one,), kind = envelope["signatures"], f"application/vnd.{kind}+json"; key = keys[one["keyid"]]
	body, sig = raw = [base64.b64decode(text) for text in (envelope["payload"], one["sig"])]
	text = [base64.b64encode(each).decode() for each in raw]; no(envelope != {"payload": text[0],
		"payloadType": kind, "signatures": [{"keyid": one["keyid"], "sig": text[1]}]})
	Key.from_public_bytes(key["key"]).verify(sig, b"DSSEv1 %d %b %d %b" % (len(kind), kind.encode(),
		len(body), body)); return body, key
def void(key, at, policy, *more):  # revoked, or not valid at that time
	return key.get("revoked") or at > when(key.get("until") or "9999-12-30") or {*more,
		sha(key["key"])} & {one.rpartition(":")[2] for one in policy.get("revoked", ())}
def recorder(log, load):  # the machine that has signed the head of its log
	(policy, keys), at = trusted(load), when(log["wall_time"])
	body, key = opened(log["signed"], keys, "smsl-studio.log-head"); no(body != log["head"] or
		key["roles"] != ["recorder"] or void(key, at, policy)); return key["person"]
def judge(load, records, known, log):
	(policy, keys), last, wishes, met, before = trusted(load), {}, [], [], when("1999-01-01")
	told = [opened(one, keys, "in-toto") for f in records for one in read(f.read_bytes())["records"]]
	day = log.get("wall_time") or told and read(told[-1][0])["predicate"]["time"]
	for body, key in told:  # in order of signing; the last word of each person counts
		said, sums = read(body)["predicate"], read(body)["subject"][0]["digest"]
		at, who, may = when(said["time"]), same(key["person"]), {*map(same, key["roles"])}
		before = no(at <= before, "out of order") or at
		if at > when(day) + datetime.timedelta(minutes=5): continue  # it says nothing about this run
		good = [sums[n] for n in PARTS[1:]] in [c["hexes"][1:] for c in
			known] and sums.items() <= log.get("digests", sums).items()
		good = good and not void(key, at, policy, sha(body), *sums.values())
		no(good and said["verdict"] == "rejected", "rejected"); good = good and when(day) <= min(at +
			datetime.timedelta(policy.get("valid_days", 1e5)), when(said["expires"] or "9999-12-30"))
		wishes = [one for one in wishes if one[0] != who or said["met"]] + [(who, text, may) for text in
			said["conditions"]]; met += [(text, may) for text in said["met"] if good]
		last[who] = good and not may & {"automatic", "recorder"} and may
	good = {who: may for who, may in last.items() if may}
	seats = [same(role) for role, n in policy.get("roles", {}).items() for _ in range(min(n, 99))]
	no(len(good) < policy.get("persons", len(seats) or 1) or not any(all(seat in may for seat, may in
		zip(seats, some)) for some in itertools.permutations(good.values(), len(seats))), "too few sign")
	for who, text, may in wishes: no(who in good and text not in log.get("met", ()) and not any(text ==
		one and may & theirs for one, theirs in met), "a condition is open: " + text)
# 5 The folder: everything in it is checked, and nothing else.
def main():
	wrong, known, root = [], [], pathlib.Path("."); files = lambda way: sorted(root.glob(way))
	def load(name): return b"".join(one.read_bytes() for one in files(name))
	def tried(place, act):
		try: return act()
		except Exception as error: wrong.append(f"{place}: {str(error) or repr(error)}")
	for path in files("content/**/closure.json"): known += filter(None, [tried(path, lambda:
		content([(path.parent / f"{part}.json").read_bytes() for part in PARTS]))])
	hexes = {None, *(tried(one, lambda: sha(one.read_bytes())) for one in files("blueprint/**/*.*"))}
	logs = [tried(one, lambda: tell(known, one.read_bytes(), hexes)) or {} for one in files("logs/*")]
	said = ["No log: nothing is said about a run."] * (not logs) + [f"Not checked: {one}." for one in
		NOT_CHECKED] + ["The head of a log is signed by " + (str(tried("head", lambda: recorder(log,
		load))) if log.get("signed") else "nobody") + "." for log in logs]; records = files("records/*")
	for log in (records or files("policy.toml")) and (logs or [{}]): tried("records", lambda:
		judge(load, records, known, log))
	said += ["No record: nobody has approved this blueprint."] * (not records) + wrong
	for line in [*said, "Not consistent." if wrong else "Consistent."]:
		print(" ".join(line.split()).encode("ascii", "backslashreplace").decode()[:500])
	return bool(wrong)
if __name__ == "__main__": sys.exit(main())
